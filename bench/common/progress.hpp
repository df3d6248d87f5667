// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Shows the progress of a long run.

#include <cstdio>
#include <string>
#include <unistd.h>
#include <utility>

namespace experiments {

/// "wall: 12 of 60" on the terminal, rewritten in place.
class progress {
 public:
  progress(std::string what, int total) : what_(std::move(what)), total_(total) { show(); }
  void step() {
    ++done_;
    show();
  }

 private:
  void show() const {
    const bool terminal = isatty(STDERR_FILENO) == 1;
    if (!terminal && done_ != 0 && done_ != total_) return;
    std::fprintf(stderr, "%s%s: %d of %d%s", terminal ? "\r" : "", what_.c_str(), done_, total_,
                 !terminal || done_ == total_ ? "\n" : "");
    std::fflush(stderr);
  }
  std::string what_;
  int total_;
  int done_ = 0;
};

}  // namespace experiments
