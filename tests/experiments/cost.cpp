// SPDX-License-Identifier: BSD-3-Clause
// The yardsticks of bench/cost measure what they say: a tick written by hand returns the same bits
// as the composed one.
#include "../../bench/cost/counts.hpp"
#include "../../bench/cost/workload.hpp"
#include "support/catch.hpp"

#include <cstring>
#include <fstream>
#include <random>
#include <sstream>

namespace {

namespace ph = passive_haptics;
using random_bits = std::mt19937_64;

double between(random_bits& random, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(random);
}
bool once_in(random_bits& random, int n) {
  return random() % static_cast<unsigned>(n) == 0;
}

/// Ordinary parameters, and now and then an odd one.
cost::settings any_settings(random_bits& random) {
  cost::settings s;
  s.damping = std::exp(between(random, -6, 1));
  s.loan = once_in(random, 3) ? between(random, 0, 0.01) : 0;
  s.longest_tick = once_in(random, 4) ? 0.9e-3 : 1e-3;
  s.top_speed = once_in(random, 4) ? 3 : 100;
  s.stiffness = std::exp(between(random, 0, 14));
  s.mass = std::exp(between(random, -5, 1));
  s.hand_force = between(random, 0, 10);
  s.force_limit = between(random, 0.5, 20);
  s.rate = std::exp(between(random, -2, 4));
  if (once_in(random, 3)) s.stale_after = between(random, 0, 0.05);
  if (once_in(random, 40)) s.damping = -s.damping;
  if (once_in(random, 40)) s.longest_tick = std::nan("");
  return s;
}

/// A triangle under the origin, tilted at random; now and then upside down, or none at all.
cost::surface any_surface(random_bits& random) {
  cost::surface s{{-0.02, -0.02, 0}, {0.02, -0.02, 0}, {0, 0.03, 0}, 1};
  s.stiffness = std::exp(between(random, 3, 12));
  for (auto* node : {&s.a, &s.b, &s.c}) {
    for (double& x : *node) x += between(random, -4e-3, 4e-3);
  }
  if (once_in(random, 12)) std::swap(s.a, s.b);
  if (once_in(random, 20)) s.c = s.a;
  if (once_in(random, 20)) s.stiffness = once_in(random, 2) ? -1 : std::nan("");
  return s;
}

/// What one run met, so that the test can tell that it met everything.
struct met {
  long free = 0, contact = 0, limited = 0, debt = 0, late = 0, refused = 0, others = 0;
};

template <class Scalar>
void count(met& m, const cost::outcome<Scalar>& o) {
  ++(o.what == ph::event::late_tick         ? m.late
     : o.what == ph::event::rejected_sample ? m.refused
     : o.what == ph::event::debt            ? m.debt
     : o.what != ph::event::nominal         ? m.others
     : o.limited                            ? m.limited
     : o.depth > Scalar(0)                  ? m.contact
                                            : m.free);
}

template <class Scalar>
bool same_bits(const Scalar& a, const Scalar& b) {
  return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof(Scalar)) == 0;
}
template <class Scalar>
bool same_bits(const cost::outcome<Scalar>& a, const cost::outcome<Scalar>& b) {
  return same_bits(a.force[0], b.force[0]) && same_bits(a.force[1], b.force[1]) &&
         same_bits(a.force[2], b.force[2]) && same_bits(a.depth, b.depth) &&
         same_bits(a.energy, b.energy) && a.what == b.what && a.limited == b.limited;
}

/// A hand that wanders about the origin, jumps, and a device that now and then reports nonsense.
struct wanderer {
  random_bits& random;
  std::array<double, 3> x{0, 0, 1e-3};
  std::array<double, 3> v{};
  double dt = 1e-3;

  void step() {
    dt = once_in(random, 10) ? between(random, 0.5e-3, 1.3e-3) : 1e-3;
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] += between(random, -0.03, 0.03) - 0.02 * v[i] - 3 * x[i];
      x[i] += v[i] * dt;
    }
  }
  [[nodiscard]] std::array<double, 3> shown() {
    auto p = x;
    if (once_in(random, 200)) p[random() % 3] = std::nan("");
    if (once_in(random, 200)) p[random() % 3] = 1e30 * between(random, -1, 1);
    if (once_in(random, 200)) p[random() % 3] += 1;
    return p;
  }
  [[nodiscard]] double measured() {
    if (once_in(random, 300)) return once_in(random, 2) ? -dt : std::nan("");
    if (once_in(random, 300)) return std::numeric_limits<double>::infinity();
    return dt;
  }
};

/// Both sides through the same random runs; returns how many ticks differed.
template <class Scene>
long differences(std::uint64_t seed, met& found) {
  using S = typename Scene::scalar;
  random_bits random(seed);
  const cost::settings parameters = any_settings(random);
  auto composed = Scene::composed(parameters);
  auto by_hand = Scene::by_hand(parameters);
  wanderer hand{random};
  long different = 0;
  for (int n = 0; n < 400; ++n) {
    if (once_in(random, 20)) {
      const auto surface = any_surface(random);
      different += cost::update_any(composed, surface) != cost::update_any(by_hand, surface);
    }
    hand.step();
    // one axis is enough for the wall, and it is the one that the others press along
    auto x = hand.shown();
    if (Scene::space::dof == 1) x = {x[2], 0, 0};
    const double dt = hand.measured();
    const auto a = cost::outcome_of<S>(
        cost::advance(composed, cost::position_for<Scene, decltype(composed)>(x),
                      cost::time_for<Scene, decltype(composed)>(dt)));
    const auto b =
        cost::outcome_of<S>(cost::advance(by_hand, cost::position_for<Scene, decltype(by_hand)>(x),
                                          cost::time_for<Scene, decltype(by_hand)>(dt)));
    different += !same_bits(a, b);
    count(found, a);
  }
  return different;
}

}  // namespace

TEMPLATE_TEST_CASE("a tick written by hand returns the bits of the composed one", "[cost]",
                   cost::wall<float>, cost::wall<double>, cost::half_space<float>,
                   cost::half_space<double>, cost::triangle<float>, cost::triangle<double>) {
  met found;
  long different = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    different += differences<TestType>(seed, found);
  }
  CHECK(different == 0);
  // the control: the runs went everywhere
  INFO("free " << found.free << ", contact " << found.contact << ", limited " << found.limited
               << ", debt " << found.debt << ", late " << found.late << ", refused "
               << found.refused << ", others " << found.others);
  CHECK(found.free > 1000);
  CHECK(found.contact > 1000);
  CHECK(found.limited > 1000);
  CHECK(found.late > 1000);
  CHECK(found.refused > 1000);
  CHECK(found.others > 100);
}

TEST_CASE("the workload takes every path of every scene", "[cost]") {
  const auto ticks = [](const std::vector<cost::step>& steps, cost::path p) {
    return std::count_if(steps.begin(), steps.end(), [p](const auto& s) { return s.taken == p; });
  };
  const auto wall = cost::workload<cost::wall<double>>();
  const auto half_space = cost::workload<cost::half_space<double>>();
  const auto triangle = cost::workload<cost::triangle<double>>();
  for (const auto path : cost::all_paths) {
    INFO(cost::to_string(path));
    CHECK(ticks(triangle, path) > 0);
    if (path == cost::path::following) continue;  // these two do not move
    CHECK(ticks(wall, path) > 0);
    CHECK(ticks(half_space, path) > 0);
  }
}

namespace {

/// As callgrind writes it, cut down to what is read.
const std::string callgrind_file =
    "# callgrind format\n"
    "fn=void cost::along<(cost::path)3, cost::wall<float>, X>(X)\n"
    "0 12\n"
    "cfn=auto cost::probe<cost::wall<float>, passive_haptics::v0::local_model<A>, float>(A&)\n"
    "calls=10 0\n"
    "0 1290\n"
    "cfn=something else\n"
    "calls=4 0\n"
    "0 77\n"
    "fn=void cost::along<(cost::path)3, cost::wall<float>, Y>(Y)\n"
    "cfn=auto cost::probe<cost::wall<float>, by_hand::in_float::wall, float>(W&)\n"
    "calls=10 0\n"
    "0 1200\n"
    "fn=main\n"
    "cfn=auto cost::probe<cost::wall<float>, by_hand::in_float::wall, float>(W&)\n"
    "calls=3 0\n"
    "0 9999\n";

cost::counts counted_once() {
  std::istringstream file(callgrind_file);
  return {"g++ 12.2.0", cost::read_callgrind(file)};
}

}  // namespace

TEST_CASE("the counts of a tick are those of its calls, by path", "[cost]") {
  const cost::counts now = counted_once();
  REQUIRE(now.rows.size() == 2);
  const auto* composed = now.find("wall, float, composed, limited");
  REQUIRE(composed != nullptr);
  CHECK(composed->ticks == 10);
  CHECK(composed->instructions == 1290);
  const auto* by_hand = now.find("wall, float, by hand, limited");
  REQUIRE(by_hand != nullptr);
  CHECK(by_hand->instructions == 1200);  // what main calls is not a tick of the workload
  CHECK(now.ratio("wall", "float") == 1290. / 1200.);
}

TEST_CASE("each tick on a mesh is a dump of its own; the last one of a program is none", "[cost]") {
  std::istringstream dumps(
      "part: 1\ndesc: Trigger: Client Request: 72 0.100000 0\nsummary: 100\ntotals: 100\n"
      "part: 2\ndesc: Trigger: Client Request: 72 0.100000 0\nsummary: 300\ntotals: 300\n"
      "part: 3\ndesc: Trigger: Client Request: 72 0.100000 30\nsummary: 70\ntotals: 70\n"
      "part: 4\ndesc: Trigger: Program termination\nsummary: 9999\ntotals: 9999\n");
  const auto rows = cost::read_mesh_dumps(dumps);
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].triangles == 72);
  CHECK(rows[0].speed == 0.1);
  CHECK(rows[0].ticks == 2);
  CHECK(rows[0].mean() == 200.0);
  CHECK(rows[0].spread() == 1.5);
  CHECK(rows[1].news == 30);
  CHECK(rows[1].largest == 70);
}

TEST_CASE("growth of more than 1 % over the baseline fails, by name; less does not", "[cost]") {
  const cost::counts now = counted_once();
  std::ostringstream text;
  cost::write_baseline(text, {now});
  std::istringstream written(text.str());
  auto committed = cost::read_baseline(written);
  REQUIRE(committed["g++ 12.2.0"].size() == 2);

  const auto same = cost::compare(committed, now);
  CHECK(same.known);
  CHECK(same.sentences.empty());

  double& before = committed["g++ 12.2.0"]["wall, float, composed, limited"];
  before = 129 / 1.009;
  CHECK(cost::compare(committed, now).sentences.empty());
  before = 129 / 1.011;
  const auto grown = cost::compare(committed, now);
  REQUIRE(grown.sentences.size() == 1);
  CHECK(grown.sentences[0].find("wall, float, composed, limited grew by 1.1 %") !=
        std::string::npos);
  before = 129 * 2;  // less is no complaint
  CHECK(cost::compare(committed, now).sentences.empty());

  committed["g++ 12.2.0"]["wall, float, composed, air"] = 80;
  const auto gone = cost::compare(committed, now);
  REQUIRE(gone.sentences.size() == 1);
  CHECK(gone.sentences[0].find("was not counted") != std::string::npos);

  cost::counts newer = now;
  newer.compiler = "g++ 99.0.0";
  CHECK_FALSE(cost::compare(committed, newer).known);
}

TEST_CASE("the committed baseline is readable and has all scenes of both compilers", "[cost]") {
  std::ifstream file(PASSIVE_HAPTICS_COST_BASELINE);
  REQUIRE(file.good());
  const auto committed = cost::read_baseline(file);
  CHECK(committed.size() >= 2);
  for (const auto& [compiler, rows] : committed) {
    INFO(compiler);
    // 64 of the scenes, two sides of 2 x 5 + 6 paths, and 14 parts in two ports of 5 paths
    CHECK(rows.size() == 204);
  }
  std::istringstream broken("heading\ng++,wall,float,composed,air,many\n");
  CHECK_THROWS_AS(cost::read_baseline(broken), std::runtime_error);
}
