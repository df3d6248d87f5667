// SPDX-License-Identifier: BSD-3-Clause
// The table says what the finite elements say, its file survives whatever happens to it, or is refused.
#include "environment/touch_alike.hpp"
#include <passive_haptics/environment/compliance_table.hpp>
#include <passive_haptics/environment/several_contacts.hpp>

#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>

#if defined(__unix__)
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace {

namespace fs = std::filesystem;

struct scene {
  env::tetrahedral_mesh mesh = env::scaled(blocks(4, [](int, int, int) { return true; }), 0.02);
  std::vector<int> held;
  std::vector<int> patch;
  std::uint64_t id;
  fs::path path;

  scene() {
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
      if (mesh.nodes[i].z() < 1e-6) held.push_back(static_cast<int>(i));
    }
    // 60 of the 98 nodes of the surface, some of them held: two blocks, the last one not full.
    patch = env::patch_around(env::boundary(mesh), mesh.nodes, {0.02, 0.08, 0.06}, 60);
    id = env::fingerprint_of(mesh, soft, held);
    path = fs::temp_directory_path() / sentence_of_this();
    clear();
  }
  ~scene() { clear(); }
  [[nodiscard]] env::tetrahedral_fem fem() const { return {mesh, soft, held}; }
  [[nodiscard]] fs::path part() const { return path.string() + ".part"; }
  void clear() const {
    fs::remove(path);
    fs::remove(part());
  }
  [[nodiscard]] std::string sentence_of_this() const {
    return env::sentence("passive_haptics_table_", static_cast<const void*>(this), "_",
                         std::random_device{}());
  }
  template <class Scalar = float>
  [[nodiscard]] std::string fault() const {
    const auto loaded = env::load_table<Scalar>(path, id, mesh.nodes.size());
    REQUIRE(loaded.table.has_value() != loaded.fault.has_value());
    return loaded.fault ? loaded.fault->what() : "";
  }
};

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
void write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A solver whose columns do not fit into memory.
struct throwing_columns : env::multifrontal {
  [[nodiscard]] static Eigen::MatrixXd columns(std::span<const int> /*loaded*/,
                                               std::span<const int> /*wanted*/) {
    throw std::bad_alloc();
  }
};

template <class Scalar>
void compare(double tolerance) {
  const scene s;
  auto fem = s.fem();
  env::compute_table<Scalar>(s.path, fem, s.id, s.patch, {.threads = 2});
  CHECK_FALSE(fs::exists(s.part()));
  const auto table = env::read_table<Scalar>(s.path, s.id, s.mesh.nodes.size());
  CHECK(table.nodes() == s.patch);
  int outside = 0;
  for (const int b : s.patch) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      std::vector<Vector3d> forces(s.mesh.nodes.size(), Vector3d::Zero());
      forces[std::size_t(b)] = Vector3d::Unit(c);
      const auto& u = fem.displacements(forces);
      double largest = 1e-300;
      for (const auto& one : u) largest = std::max(largest, one.norm());
      for (int a = 0; a < static_cast<int>(s.mesh.nodes.size()); ++a) {
        const Vector3d found = table.between(a, b).col(c);
        if (table.moves(a)) {
          REQUIRE((found - u[std::size_t(a)]).norm() <= tolerance * largest);
        } else {
          REQUIRE(found.isZero(0.0));
          ++outside;
        }
      }
    }
  }
  CHECK(outside > 100);
}

}  // namespace

TEST_CASE("a compliance table is the inverse of the stiffness on its patch",
          "[environment][table]") {
  compare<double>(1e-10);
  compare<float>(1e-5);
}

TEST_CASE("a body on a table is the body of finite elements as long as it is touched on the patch",
          "[environment][table]") {
  scene s;
  s.patch = env::patch_around(env::boundary(s.mesh), s.mesh.nodes, {0, 0, 0}, 1000);  // all of it
  const auto fem = s.fem();
  env::compute_table<double>(s.path, fem, s.id, s.patch);
  env::deformable_body elements(s.mesh, soft, s.held);
  env::basic_deformable_body<env::compliance_table<double>> table(
      s.mesh, env::read_table<double>(s.path, s.id, s.mesh.nodes.size()));
  CHECK(touch_alike(elements, table, 200, 31) > 50);
}

TEST_CASE("a table that was stopped goes on where it was", "[environment][table]") {
  const scene s;
  const auto fem = s.fem();
  env::compute_table(s.path, fem, s.id, s.patch);
  const std::string whole = bytes_of(s.path);
  s.clear();
  int asked = 0;
  const auto once = [&](double) { return ++asked < 2; };
  const auto stop = [&] {
    env::compute_table(s.path, fem, s.id, s.patch, {.threads = 1, .tell = once});
  };
  CHECK(contains(text_of<env::stopped_by_caller>(stop), "has 1 of 2 blocks"));
  CHECK_FALSE(fs::exists(s.path));  // nothing half-written under its name
  const std::string half = bytes_of(s.part());
  CHECK(whole.starts_with(half));
  std::vector<double> told;
  const auto listen = [&](double done) {
    told.push_back(done);
    return true;
  };
  const auto go_on = [&] {
    told.clear();
    env::compute_table(s.path, fem, s.id, s.patch, {.threads = 1, .tell = listen});
    CHECK(bytes_of(s.path) == whole);
    fs::remove(s.path);
  };
  go_on();
  CHECK(told == std::vector<double>{0.5});
  // Killed in the middle of a block, damaged, of another body: what cannot be trusted is computed again.
  write(s.part(), half + whole.substr(half.size(), 100));
  go_on();
  CHECK(told == std::vector<double>{0.5});
  std::string damaged = half;
  damaged[half.size() / 2] = static_cast<char>(damaged[half.size() / 2] ^ 1);
  write(s.part(), damaged);
  go_on();
  CHECK(told == std::vector<double>{0.0, 0.5});
  write(s.part(), half.substr(0, 70));
  go_on();
  CHECK(told.size() == 2);
  std::string other = half;
  other[32] = static_cast<char>(other[32] ^ 1);
  write(s.part(), other);
  go_on();
  CHECK(told.size() == 2);
}

TEST_CASE("a table can be stopped whenever it asks, and is the same in the end",
          "[environment][table]") {
  scene s;
  s.patch = env::patch_around(env::boundary(s.mesh), s.mesh.nodes, {0, 0, 0}, 1000);  // four blocks
  const auto fem = s.fem();
  env::compute_table(s.path, fem, s.id, s.patch);
  const std::string whole = bytes_of(s.path);
  s.clear();
  for (const int threads : {1, 3}) {
    int stops = 0;
    for (bool is_done = false; !is_done;) {
      int asked = 0;  // each run gets one round further
      const auto once = [&](double) { return ++asked < 2; };
      const auto text = text_of<env::stopped_by_caller>([&] {
        env::compute_table(s.path, fem, s.id, s.patch, {.threads = threads, .tell = once});
        is_done = true;
      });
      CHECK(is_done == text.empty());
      CHECK(fs::exists(s.path) == is_done);
      stops += is_done ? 0 : 1;
    }
    CHECK(stops == (threads == 1 ? 3 : 1));
    CHECK(bytes_of(s.path) == whole);
    s.clear();
  }
  // Whatever is thrown on the way, by a thread or by who is told, comes out, and the rest is as if stopped.
  const auto throws = [&](double done) -> bool {
    if (done > 0.4) throw std::length_error("told");
    return true;
  };
  CHECK(text_of<std::length_error>([&] {
          env::compute_table(s.path, fem, s.id, s.patch, {.threads = 1, .tell = throws});
        }) == "told");
  CHECK_FALSE(fs::exists(s.path));
  CHECK(whole.starts_with(bytes_of(s.part())));
  using broken = env::basic_tetrahedral_fem<throwing_columns>;
  CHECK(text_of<std::bad_alloc>([&] {
          env::compute_table(s.path, broken(s.mesh, soft, s.held), s.id, s.patch, {.threads = 4});
        }).empty() == false);
  CHECK_FALSE(fs::exists(s.path));
  env::compute_table(s.path, fem, s.id, s.patch);
  CHECK(bytes_of(s.path) == whole);
}

#if defined(__unix__)
TEST_CASE("a table whose computation was killed goes on where it was", "[environment][table]") {
  scene s;
  s.patch = env::patch_around(env::boundary(s.mesh), s.mesh.nodes, {0, 0, 0}, 1000);  // four blocks
  const auto fem = s.fem();
  env::compute_table(s.path, fem, s.id, s.patch);
  const std::string whole = bytes_of(s.path);
  s.clear();
  const auto header = env::header_for(s.id, s.patch, 4);
  REQUIRE(header.blocks() == 4);
  for (std::size_t blocks = 0; blocks < 4; ++blocks) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      ::alarm(60);  // whatever becomes of the parent
      const auto wait_there = [&](double done) {
        while (done * 4.0 > static_cast<double>(blocks) - 0.5) ::pause();
        return true;
      };
      env::compute_table(s.path, fem, s.id, s.patch, {.threads = 1, .tell = wait_there});
      ::_exit(0);
    }
    const auto has = [&] { return fs::exists(s.part()) ? fs::file_size(s.part()) : 0; };
    for (int i = 0; i < 5000 && has() < header.begin_of(blocks); ++i) ::usleep(2000);
    ::kill(child, SIGKILL);
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    CHECK_FALSE(fs::exists(s.path));
    CHECK(bytes_of(s.part()) == whole.substr(0, header.begin_of(blocks)));
    std::vector<double> told;
    const auto listen = [&](double done) {
      told.push_back(done);
      return true;
    };
    env::compute_table(s.path, fem, s.id, s.patch, {.threads = 1, .tell = listen});
    CHECK(told.size() == 4 - blocks);
    CHECK(bytes_of(s.path) == whole);
    s.clear();
  }
}
#endif

TEST_CASE("a table whose sizes are beyond all numbers is refused before it is read",
          "[environment][table]") {
  const scene s;
  env::table_header header;  // its sizes add up to 72 MB modulo 2^64, and its list alone has 7.6 GB
  header.nodes = 1893902559;
  header.block_nodes = 137;
  header.body = s.id;
  header.checksum = header.right_checksum();
  const std::size_t size = header.begin_of(header.blocks());
  REQUIRE(size == 71733568);
  write(s.path, std::string(reinterpret_cast<const char*>(&header), sizeof(header)));
  std::filesystem::resize_file(s.path, size);  // sparse
  CHECK(contains(s.fault(), "has 71733568 bytes, too few for 1893902559 nodes"));
}

TEST_CASE("a table that is not what it should be is refused with a sentence",
          "[environment][table]") {
  const scene s;
  env::compute_table(s.path, s.fem(), s.id, s.patch);
  const std::string good = bytes_of(s.path);
  CHECK(s.fault().empty());
  CHECK(contains(s.fault<double>(), "scalars of 4 bytes where 8 are asked for"));
  const auto with = [&](const std::string& bytes) {
    write(s.path, bytes);
    return s.fault();
  };
  for (const std::size_t size : {std::size_t{1}, std::size_t{63}, std::size_t{64}, std::size_t{200},
                                 good.size() / 2, good.size() - 1}) {
    CHECK_FALSE(with(good.substr(0, size)).empty());
  }
  CHECK(contains(with(good.substr(0, 63)), "has only 63 bytes"));
  CHECK(contains(with(good.substr(0, good.size() - 64)),
                 env::sentence("has ", good.size() - 64, " bytes of ", good.size())));
  CHECK(contains(with(good + good), "bytes of"));
  CHECK(contains(with(""), "cannot be opened, or is empty"));
  // One bit anywhere, but for the padding behind the checksum of the last block and behind the list.
  std::mt19937 random(32);
  int refused = 0;
  for (int run = 0; run < 200; ++run) {
    std::string bad = good;
    const std::size_t at = run < 64 ? std::size_t(run) : random() % (good.size() - 64);
    bad[at] = static_cast<char>(bad[at] ^ (1 << random() % 8));
    refused += with(bad).empty() ? 0 : 1;
  }
  CHECK(refused >= 198);
  std::string turned = good;  // as a machine of the other byte order has written it
  for (const auto& [at, size] :
       {std::pair{8, 4}, {12, 4}, {16, 4}, {20, 4}, {24, 4}, {32, 8}, {40, 8}, {56, 8}})
    std::reverse(turned.begin() + at, turned.begin() + at + size);
  CHECK(contains(with(turned), "the other byte order; compute the table on this machine"));
  CHECK(contains(with(std::string(100, 'x')), "is no compliance table"));
  write(s.path, good);
  auto stiffer = soft;
  stiffer.young *= 1.0 + 1e-12;
  auto moved = s.mesh;
  moved.nodes[7].x() += 1e-15;
  for (const auto id :
       {env::fingerprint_of(s.mesh, stiffer, s.held), env::fingerprint_of(moved, soft, s.held),
        env::fingerprint_of(s.mesh, soft, std::span(s.held).first(5))}) {
    const auto loaded = env::load_table<float>(s.path, id, s.mesh.nodes.size());
    REQUIRE(loaded.fault);
    CHECK(contains(loaded.fault->what(),
                   "another mesh, material or other fixed nodes; delete the file"));
  }
  // A mesh that is not the one: by its number of nodes, in the table and in the body.
  const auto few = env::load_table<float>(s.path, s.id, 50);
  REQUIRE(few.fault);
  CHECK(contains(few.fault->what(), "of 50; give the number of nodes of the mesh"));
  const int last = s.patch.back();  // in ascending order
  const auto one_too_few = env::load_table<float>(s.path, s.id, std::size_t(last));
  REQUIRE(one_too_few.fault);
  CHECK(contains(one_too_few.fault->what(), env::sentence("names node ", last, " of ", last)));
  CHECK_FALSE(env::load_table<float>(s.path, s.id, std::size_t(last) + 1).fault);
  const auto on = [&](const env::tetrahedral_mesh& mesh) {
    using body = env::basic_deformable_body<env::compliance_table<float>>;
    return text_of<std::invalid_argument>(
        [&] { body(mesh, env::read_table(s.path, s.id, s.mesh.nodes.size())); });
  };
  CHECK(on(s.mesh).empty());
  CHECK(contains(on(env::ball(0.05)), "a solid of 125 nodes is refused on a mesh of 11"));
  fs::remove(s.path);
  CHECK(contains(s.fault(), "compute the table first"));
  CHECK(contains(text_of<env::table_error>([&] { (void)env::read_table(s.path, s.id, 125); }),
                 "cannot be opened"));
  CHECK(contains(text_of<std::invalid_argument>([&] {
                   env::compute_table(s.path, s.fem(), s.id, std::vector{3, 125});
                 }),
                 "node 125 is refused"));
  CHECK(contains(text_of<std::invalid_argument>(
                     [&] { env::compute_table(s.path, s.fem(), s.id, std::vector<int>{}); }),
                 "no nodes"));
  CHECK(contains(text_of<env::table_error>([&] {
                   env::compute_table("/no such folder/organ.table", s.fem(), s.id, s.patch);
                 }),
                 "cannot be written"));
}

TEST_CASE("several contacts push, never pull, and none goes through", "[environment][table]") {
  const scene s;
  env::compute_table<double>(s.path, s.fem(), s.id, s.patch);
  const auto table = env::read_table<double>(s.path, s.id, s.mesh.nodes.size());
  std::vector<env::contact_point> all;
  for (const auto& t : env::boundary(s.mesh)) {
    const bool free = std::all_of(t.nodes.begin(), t.nodes.end(), [&](int n) {
      return table.moves(n) && s.mesh.nodes[std::size_t(n)].z() > 1e-6;
    });
    if (free) {
      all.push_back({t.nodes, {0.2, 0.3, 0.5}, env::unit_normal(env::corners(t, s.mesh.nodes))});
    }
  }
  REQUIRE(all.size() > 20);
  std::mt19937 random(33);
  int left = 0;
  for (int run = 0; run < 200; ++run) {
    std::shuffle(all.begin(), all.end(), random);
    const std::size_t count = 1 + random() % 8;
    const auto some = std::span(all).first(count);
    const auto G = env::capacitance(table, some);
    CHECK(G.isApprox(G.transpose(), 0.0));
    Eigen::VectorXd depth(static_cast<Eigen::Index>(count));
    for (auto& d : depth) d = 1e-3 * (anything(random).x() + 0.5);
    const auto f = env::contact_forces(G, depth);
    CHECK(f.minCoeff() >= 0.0);
    const Eigen::VectorXd gap = G * f - depth;
    CHECK(gap.minCoeff() >= -1e-11);
    CHECK(std::abs(f.dot(gap)) < 1e-11 * (1.0 + f.sum()));
    // A contact that is deep in the body at rest, and yet free beside its neighbours.
    for (Eigen::Index i = 0; i < f.size(); ++i) left += depth[i] > 0.0 && f[i] == 0.0 ? 1 : 0;
  }
  CHECK(left > 0);
  for (const auto& one : all) {  // rounded, the last pivot of some is above zero
    const std::array twice{one, one};
    CHECK(contains(text_of<std::invalid_argument>([&] {
                     (void)env::contact_forces(env::capacitance(table, twice),
                                               Eigen::Vector2d(1, 1));
                   }),
                   "not positive definite"));
  }
  CHECK_THROWS_AS(env::contact_forces(Eigen::Matrix2d::Identity(), Eigen::Vector3d(1, 1, 1)),
                  std::invalid_argument);
  CHECK_THROWS_AS(
      env::contact_forces(Eigen::Matrix2d::Identity(), Eigen::Vector2d(1, not_a_number)),
      std::invalid_argument);
}
