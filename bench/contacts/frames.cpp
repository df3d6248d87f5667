// SPDX-License-Identifier: BSD-3-Clause
// A collision search numbers nothing: what there is comes 30 times a second in another order, and more of it than there
// are slots. Told to a contact_manifold, and by its number in the list, against surfaces that each have their own slot.
#include "quiet.hpp"
#include <passive_haptics/constraint_geometry/sphere.hpp>
#include <passive_haptics/contact/manifold.hpp>
#include <passive_haptics/energy_observer/no_observer.hpp>
#include <passive_haptics/force_bound/actuator_limit.hpp>

namespace contacts {

namespace {

constexpr int frame = 33, news_end = 2000, run_end = 3000;  // [ticks]

/// What a finger feels, against own slots.
struct told {
  double angle = 0.0;  ///< between the two forces, at most [rad]
  double step = 0.0;   ///< the largest of the force in a tick [N]
  double off = 0.0;    ///< of the force, at most [N]
  double late = 0.0;   ///< of the force, a second after the last frame, at most [N]
};
struct frame_row {
  std::string scene;
  int cases = 1;
  bool held = true;      ///< the finger holds still, so that all steps are the news'
  bool the_same = true;  ///< as own slots at all times, and not only a second after the last frame
  told manifold{}, number{};
  int surfaces = 0, left_out = 0;  ///< of a frame, at most
};
ex::record record_of(const frame_row& r) {
  return {{"scene", r.scene},
          {"cases", r.cases},
          {"surfaces", r.surfaces},
          {"left_out", r.left_out},
          {"off_deg", r.manifold.angle / degree, "%.2f"},
          {"by_number", r.number.angle / degree, "%.1f"},
          {"off_N", r.manifold.off, "%.4f"},
          {"by_number_N", r.number.off, "%.3f"},
          {"after_1_s_N", r.manifold.late, "%.1e"},
          {"largest_step_N", r.manifold.step, "%.4f"},
          {"step_by_number_N", r.number.step, "%.4f"}};
}

template <class Surface, int Count>
auto open_set() {
  return ph::passive_port{
      d3{},
      ph::contact_set{ph::proxy_spring{.mass = 0.1}, ph::pursuit{}, ph::slots<Surface, Count>{}},
      ph::no_observer{}, ph::no_bound{}, ph::loop_limits{.longest_tick = T, .top_speed = 1e4}};
}
void shuffle(auto& all, draws& d) {
  for (int i = static_cast<int>(all.size()) - 1; i > 0; --i) {
    std::swap(all[static_cast<std::size_t>(i)], all[static_cast<std::size_t>(d.count(0, i))]);
  }
}

/// All surfaces that there may be, and those that there are. Of the first `Own` any may press, of the others none.
template <class Surface>
struct world {
  std::vector<Surface> all;
  std::vector<char> there;
  void add(const Surface& s, bool is_there = true) {
    all.push_back(s);
    there.push_back(is_there ? 1 : 0);
  }
};

/// next(world, x) is called before each frame, at(tick) is where the finger is.
template <class Surface, int Own, int Room>
void run(frame_row& row, world<Surface> w, draws& d, const auto& at, const auto& next) {
  auto own = open_set<Surface, Own>();
  auto matched = open_set<Surface, Room>();
  auto numbered = open_set<Surface, Room>();
  ph::contact_manifold<Surface, Room> seen;
  std::vector<char> was(w.all.size(), 0);
  std::vector<Surface> now;
  vector last = vector::Zero(), last_numbered = vector::Zero();
  for (int n = 0; n < run_end; ++n) {
    const vector x = at(n);
    if (n % frame == 0 && n < news_end) {
      next(w, x);
      now.clear();
      for (std::size_t i = 0; i < w.all.size(); ++i) {
        if (w.there[i] != 0) now.push_back(w.all[i]);
        if (i >= std::size_t{Own}) continue;
        if (w.there[i] != 0) own.source().update(static_cast<int>(i), w.all[i]);
        if (w.there[i] == 0 && was[i] != 0) own.source().release(static_cast<int>(i));
      }
      was = w.there;
      shuffle(now, d);
      row.left_out = std::max(row.left_out, seen.show(matched.source(), now, x).left_out);
      row.surfaces = std::max(row.surfaces, static_cast<int>(now.size()));
      for (int i = 0; i < Room; ++i) {
        if (i < static_cast<int>(now.size())) {
          numbered.source().update(i, now[static_cast<std::size_t>(i)]);
        } else {
          numbered.source().release(i);
        }
      }
    }
    const vector wanted = own.tick(x, ph::seconds{T}).force;
    const auto judge = [&](told& to, auto& port, vector& before) {
      const vector f = port.tick(x, ph::seconds{T}).force;
      if (wanted.norm() > 0.1) {
        to.angle = std::max(to.angle, std::atan2(d3::cross(f, wanted).norm(), f.dot(wanted)));
      }
      to.off = std::max(to.off, (f - wanted).norm());
      if (n == run_end - 1) to.late = std::max(to.late, (f - wanted).norm());
      if (n >= 200) to.step = std::max(to.step, (f - before).norm());
      before = f;
    };
    judge(row.manifold, matched, last);
    judge(row.number, numbered, last_numbered);
  }
}
constexpr auto as_it_is = [](const auto& /*world*/, const vector& /*x*/) {};
/// From 8 mm outside to the origin, where it holds still.
auto held_at_origin(const vector& out) {
  return [=](int n) -> vector { return out * std::max(0.0, 8e-3 - 1e-4 * n); };
}

/// A wall whose surface is 0.5 to 3 mm outside of the origin.
plane any_wall(draws& d, const vector& n, double K) {
  return {vector(n * d.between(0.5e-3, 3e-3)), n, K};
}

void corner(frame_row& row, draws& d, bool right_angled) {
  world<plane> w;
  const double K = d.scale(300.0, 3000.0);
  const vector z = d.direction(), x = d3::orthogonal(z), y = d3::cross(z, x);
  for (const vector& axis : {x, y, z}) {
    vector n = axis;
    if (!right_angled) n = (axis + 0.5 * d.direction()).normalized();
    w.add(any_wall(d, n, K));
  }
  run<plane, 3, 3>(row, w, d, held_at_origin(vector((x + y + z).normalized())), as_it_is);
}
/// A crowd of walls that come and go, of which some go as others come.
void come_and_go(frame_row& row, draws& d) {
  world<plane> w;
  const vector z = d.direction();
  for (int i = 0; i < 12; ++i) {
    const vector n = (z + 0.7 * d.direction()).normalized();
    w.add(any_wall(d, n, d.scale(300.0, 3000.0)), d.chance(0.4));
  }
  run<plane, 12, 12>(row, w, d, held_at_origin(z), [&](auto& now, const vector&) {
    for (auto& there : now.there) {
      if (d.chance(0.05)) there = there == 0 ? 1 : 0;
    }
    const auto any = [&]() -> auto& {
      return now.there[static_cast<std::size_t>(d.count(0, 11))];
    };
    if (d.chance(0.3)) std::swap(any(), any());
  });
}
/// A row of balls, of which a finger that strokes them is told those within reach.
void heap(frame_row& row, draws& d) {
  using ball = ph::sphere<d3>;
  world<ball> w;
  for (int i = 0; i < 40; ++i) {
    const double along = d.between(-0.04, 0.04), aside = d.between(-0.01, 0.01);
    w.add({.centre = {along, aside, -0.02}, .radius = d.between(0.018, 0.022), .stiffness = 500.0});
  }
  const auto stroke = [](int n) {
    return vector(-0.03 + 3e-5 * std::min(n, news_end), 0.0, std::max(-1e-3, 5e-3 - 1e-4 * n));
  };
  run<ball, 40, 16>(row, w, d, stroke, [](auto& now, const vector& x) {
    int room = 16;
    for (std::size_t i = 0; i < now.all.size(); ++i) {
      now.there[i] = now.all[i].at(x).depth > -1.5e-3 && room > 0 ? 1 : 0;
      room -= now.there[i];
    }
  });
}
/// 10 000 walls, of which three press; all others are beyond the reach of the proxy.
void crowd(frame_row& row, draws& d) {
  world<plane> w;
  const vector z = d.direction(), x = d3::orthogonal(z), y = d3::cross(z, x);
  for (const vector& n : {x, y, z}) w.add(any_wall(d, n, 1000.0));
  while (w.all.size() < 10000) {
    const vector n = d.direction();
    w.add({vector(n * -d.between(0.012, 0.1)), n, d.scale(300.0, 3000.0)});
  }
  run<plane, 3, 16>(row, w, d, held_at_origin(vector((x + y + z).normalized())), as_it_is);
}

/// How many surfaces a slow finger has looked at in each tick.
thread_local long looks = 0;
struct counted : plane {
  using space_type = d3;
  [[nodiscard]] auto at(const vector& x) const noexcept {
    ++looks;
    return plane::at(x);
  }
};
struct reach_row {
  double pressed = 0.0;  ///< at most [m]
  int cases = 0;
  bool framed = false;           ///< all are shown again in each frame
  double all = 0.0, near = 0.0;  ///< looks a tick, of 64 surfaces, and of the three alone
  double worst = 0.0;            ///< of both, at most
  double off = 0.0;              ///< of the force [N]
};
ex::record record_of(const reach_row& r) {
  return {{"surfaces", 64},
          {"near", 3},
          {"pressed_mm", r.pressed * 1e3, "%.1f"},
          {"cases", r.cases},
          {"frames", r.framed ? "each 33 ms" : "one"},
          {"looks_a_tick", r.all, "%.2f"},
          {"of_the_near_alone", r.near, "%.2f"},
          {"times_at_most", r.worst, "%.2f"},
          {"off_N", r.off, "%.1e"}};
}
reach_row reach(double pressed, bool framed, int cases, std::uint64_t seed) {
  reach_row row{.pressed = pressed, .cases = cases, .framed = framed};
  draws d(seed);
  for (int i = 0; i < cases; ++i) {
    auto many = open_set<counted, 64>();
    auto few = open_set<counted, 3>();
    ph::contact_manifold<counted, 64> seen;
    ph::contact_manifold<counted, 3> seen_alone;
    std::vector<counted> all, alone;
    const vector z = d.direction(), x = d3::orthogonal(z), y = d3::cross(z, x);
    for (int k = 0; k < 64; ++k) {
      const vector n = k == 0 ? x : k == 1 ? y : k == 2 ? z : vector(d.direction());
      const double at = k < 3 ? d.between(0.2, 1.0) * pressed : -d.between(0.04, 0.2);
      const counted wall{{vector(n * at), n, 1000.0}};
      all.push_back(wall);
      if (k < 3) alone.push_back(wall);
    }
    const vector way = d.direction();
    long in_many = 0, in_few = 0;
    const double far = pressed / 2.0;
    for (int n = 0; n < run_end; ++n) {  // to and fro, at 10 mm/s at most
      const vector at = way * (far * std::sin(0.01 / far * T * n));
      if (n == 0 || (framed && n % frame == 0)) {
        seen.show(many.source(), all, at);
        seen_alone.show(few.source(), alone, at);
      }
      looks = 0;
      const vector f = many.tick(at, ph::seconds{T}).force;
      in_many += looks;
      looks = 0;
      row.off = std::max(row.off, vector(few.tick(at, ph::seconds{T}).force - f).norm());
      in_few += looks;
    }
    const double a = static_cast<double>(in_many) / run_end,
                 b = static_cast<double>(in_few) / run_end;
    row.all += a / cases;
    row.near += b / cases;
    row.worst = std::max(row.worst, a / b);
  }
  return row;
}

using frame_job = std::pair<frame_row, void (*)(frame_row&, draws&)>;

}  // namespace

std::vector<std::string> run_frames(const session& s) {
  s.out.section(
      "Frames",
      "What there is comes 30 times a second in another order, drawn with --seed " +
          std::to_string(s.chosen.seed) +
          ": off, the force through a contact_manifold against that of surfaces that each have a "
          "slot of their own, in degrees, in newtons, and a second after the last frame; "
          "by_number: told to the slots in the "
          "order of the list. Steps: of a finger that holds still, but for the heap of balls.");
  const int cases = s.chosen.quick ? 3 : 100;
  const std::vector<frame_job> jobs{
      {{.scene = "corner of 3 walls", .cases = cases},
       [](frame_row& r, draws& d) { corner(r, d, true); }},
      {{.scene = "corner of any angle", .cases = cases},
       [](frame_row& r, draws& d) { corner(r, d, false); }},
      {{.scene = "12 walls that come, go and take turns", .cases = cases, .the_same = false},
       come_and_go},
      {{.scene = "heap of 40 balls, stroked", .cases = cases, .held = false}, heap},
      {{.scene = "10000 walls, 3 pressed", .cases = s.chosen.quick ? 1 : 10}, crowd}};
  const auto rows = s.rows("frames.csv", "frames", jobs, [&](const frame_job& job) {
    frame_row row = job.first;
    draws d((static_cast<std::uint64_t>(s.chosen.seed) << 32U) +
            static_cast<std::uint64_t>(&job - jobs.data()));
    for (int i = 0; i < row.cases; ++i) job.second(row, d);
    return row;
  });
  ex::show_rows(s.out, "frames", rows);

  s.out.section(
      "Frames: what is near",
      "A finger at 10 mm/s in a corner of three walls that it presses by up to so much "
      "and half as much, with 61 "
      "more that are 40 to 200 mm away, shown once or again each 33 ms: surfaces that are "
      "looked at in a tick. The bar is twice those of the "
      "three alone for 1 mm, and half of all beyond.");
  std::vector<reach_row> near;
  for (const double pressed : {1e-3, 3e-3}) {
    for (const bool framed : {false, true}) {
      near.push_back(reach(pressed, framed, s.chosen.quick ? 5 : 100,
                           static_cast<std::uint64_t>(s.chosen.seed)));
    }
  }
  ex::publish(s.out, "frames_near", near);

  std::vector<std::string> found;
  for (const auto& r : rows) {
    const auto bar = [&](double is, double most, const std::string& what) {
      expect(found, is <= most,
             "frames, " + r.scene + ": " + what + " " + ex::format("%.4g", is) + " N");
    };
    if (r.the_same) bar(r.manifold.off, 0.01, "off by");
    if (r.held) bar(r.manifold.step, ph::pursuit{}.force_rate * T * (1.0 + 1e-9), "a step of");
    bar(r.manifold.late, 1e-3, "a second later off by");
    expect(found, r.number.off > 0.1, "frames, " + r.scene + ": the control, by number, is right");
  }
  for (const auto& r : near) {
    expect(found, r.pressed > 1e-3 || r.worst <= 2.0,
           "frames: 64 surfaces are looked at " + ex::format("%.2f", r.worst) +
               " times as often as 3");
    expect(found, r.all <= 32.0, "frames: more than half of 64 surfaces are looked at in a tick");
    expect(found, r.off <= 1e-9, "frames: surfaces out of reach are felt");
  }
  return found;
}

}  // namespace contacts
