/* SPDX-License-Identifier: BSD-3-Clause */
/* A QEMU plugin (API 1) that counts the instructions between two addresses, call by call, and
   tells them apart by mnemonic. A third address begins a new series.
     -plugin libcount.so,begin=ADDRESS,end=ADDRESS,series=ADDRESS,out=FILE
   It prints   call SERIES COUNT   for every call, then   op SERIES MNEMONIC COUNT.
   QEMU's header is not packaged everywhere, so the few declarations that it needs are here. */
#include <inttypes.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
typedef struct qemu_info_t qemu_info_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum qemu_plugin_cb_flags { QEMU_PLUGIN_CB_NO_REGS };

extern void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t,
                                                  void (*)(qemu_plugin_id_t,
                                                           struct qemu_plugin_tb*));
extern void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn*,
                                                   void (*)(unsigned int, void*),
                                                   enum qemu_plugin_cb_flags, void*);
extern void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, void*),
                                           void*);
extern size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb*);
extern struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb*, size_t);
extern uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn*);
extern char* qemu_plugin_insn_disas(const struct qemu_plugin_insn*);

__attribute__((visibility("default"))) int qemu_plugin_version = 1;

enum { most_kinds = 400, most_series = 64 };
static uint64_t begin, end, next_series;
static FILE* out;
static int series = -1, counting;
static uint64_t count;
static char kinds[most_kinds][16];
static intptr_t kinds_known;
static uint64_t histogram[most_series][most_kinds];

static intptr_t kind_of(struct qemu_plugin_insn* instruction) {
  char* text = qemu_plugin_insn_disas(instruction);
  char name[16] = {0};
  for (size_t i = 0; i + 1 < sizeof name && text[i] > ' '; ++i) name[i] = text[i];
  free(text);
  for (intptr_t k = 0; k < kinds_known; ++k) {
    if (strcmp(kinds[k], name) == 0) return k;
  }
  if (kinds_known + 1 < most_kinds) ++kinds_known;
  strcpy(kinds[kinds_known - 1], name);
  return kinds_known - 1;
}

static void executed(unsigned int cpu, void* kind) {
  (void)cpu;
  if (!counting) return;
  ++count;
  ++histogram[series][(intptr_t)kind];
}
static void at_begin(unsigned int cpu, void* kind) {
  (void)cpu, (void)kind;
  counting = series >= 0 && series < most_series;
  count = 0;
}
static void at_end(unsigned int cpu, void* kind) {
  (void)cpu, (void)kind;
  if (counting) fprintf(out, "call %d %" PRIu64 "\n", series, count);
  counting = 0;
}
static void at_series(unsigned int cpu, void* kind) {
  (void)cpu, (void)kind;
  ++series;
}

static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb* block) {
  (void)id;
  for (size_t i = 0; i < qemu_plugin_tb_n_insns(block); ++i) {
    struct qemu_plugin_insn* instruction = qemu_plugin_tb_get_insn(block, i);
    const uint64_t address = qemu_plugin_insn_vaddr(instruction);
    qemu_plugin_register_vcpu_insn_exec_cb(instruction,
                                           address == begin         ? at_begin
                                           : address == end         ? at_end
                                           : address == next_series ? at_series
                                                                    : executed,
                                           QEMU_PLUGIN_CB_NO_REGS, (void*)kind_of(instruction));
  }
}

static void finished(qemu_plugin_id_t id, void* nothing) {
  (void)id, (void)nothing;
  for (int s = 0; s <= series && s < most_series; ++s) {
    for (intptr_t k = 0; k < kinds_known; ++k) {
      if (histogram[s][k] == 0) continue;
      fprintf(out, "op %d %s %" PRIu64 "\n", s, kinds[k], histogram[s][k]);
    }
  }
  fclose(out);
}

__attribute__((visibility("default"))) int qemu_plugin_install(qemu_plugin_id_t id,
                                                               const qemu_info_t* info, int argc,
                                                               char** argv) {
  (void)info;
  const char* file = "count.txt";
  for (int i = 0; i < argc; ++i) {
    if (strncmp(argv[i], "begin=", 6) == 0) begin = strtoull(argv[i] + 6, NULL, 0);
    if (strncmp(argv[i], "end=", 4) == 0) end = strtoull(argv[i] + 4, NULL, 0);
    if (strncmp(argv[i], "series=", 7) == 0) next_series = strtoull(argv[i] + 7, NULL, 0);
    if (strncmp(argv[i], "out=", 4) == 0) file = argv[i] + 4;
  }
  out = fopen(file, "w");
  if (out == NULL) return 1;
  qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
  qemu_plugin_register_atexit_cb(id, finished, NULL);
  return 0;
}
