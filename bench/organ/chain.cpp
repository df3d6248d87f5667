// SPDX-License-Identifier: BSD-3-Clause
#include "chain.hpp"

#include "published.hpp"
#include <passive_haptics/environment/compliance_table.hpp>
#include <passive_haptics/environment/vtu_writer.hpp>
#include <passive_haptics/runner.hpp>
#include <passive_haptics/runner/scope.hpp>
#include <passive_haptics/simulation/device.hpp>
#include <passive_haptics/simulation/presets.hpp>

#include <atomic>
#include <thread>

namespace organ {

namespace sim = passive_haptics::simulation;

namespace {

constexpr double mass = sim::falcon_like.mass, damping = sim::falcon_like.damping,
                 force_limit = sim::falcon_like.force_limit;
constexpr double first_second = 1.0;  // until then the hand is on its way to the organ
constexpr double late = 1.5e-3;       // a tick that is longer is late [s]

/// A hand that strokes until it holds still: a spring and a damper to where it wants to be, no stronger than 4 N.
struct stroking_hand {
  static constexpr double strongest = 4.0;
  stroke_of_organ path{};
  double until = std::numeric_limits<double>::infinity();  ///< [s]

  [[nodiscard]] vector force(double now, const vector& x, const vector& v) const noexcept {
    constexpr double dt = 1e-3;
    const double t = std::min(now, until);
    const vector target = path(t);
    const vector speed = now < until ? vector((path(t + dt) - target) / dt) : vector::Zero();
    return sim::clamp_norm<volume>(300.0 * (target - x) + 2.0 * (speed - v), strongest);
  }
  [[nodiscard]] static double mass() noexcept { return 0.0; }
  [[nodiscard]] static ph::parameter_fault check() noexcept { return {}; }
};

/// A device that is simulated as fast as time goes by: each exchange carries it, exactly, through the time
/// since the last one, under the force of the last one, which its watchdog drops.
class living_device {
 public:
  living_device(double watchdog, double stroked)
      : body_({.mass = organ::mass,
               .damping = damping,
               .force_limit = force_limit,
               .start = stroking_hand{}.path(0.0),
               .watchdog = watchdog},
              {.until = stroked}) {}

  ph::device_sample<volume> exchange(const vector& force) noexcept {
    // Its time begins with the loop, however long that took to start.
    if (!body_.set_period(watch_.lap(0.0))) return {};
    return body_.exchange(std::exchange(held_, force));
  }
  [[nodiscard]] const auto& body() const noexcept { return body_; }

 private:
  sim::device<volume, stroking_hand> body_;
  ph::stopwatch watch_;
  vector held_ = vector::Zero();
};

/// What the haptic thread tells the environment.
struct touch_news {
  volume::coordinates device{}, force{};
};

/// What both threads share, and what is known afterwards.
template <class Surface>
struct meeting {
  ph::exchange<Surface> surfaces;
  ph::exchange<touch_news> touches;
  touch_news hardest{stroke_of_organ{}(0.0),
                     vector::Zero()};  ///< that the environment has answered
  std::atomic<bool> over = false;
  std::atomic<double> haptic_cpu = 0.0;
  double environment_cpu = 0.0, update_cpu = 0.0;
  std::uint64_t updates = 0;
};

/// The slow thread: the newest touch in, the newest surface out.
template <class Surface, class Body>
void answer_touches(Body& body, meeting<Surface>& with, double rate) {
  ph::steady_pace pace(std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / rate)));
  pace.begin();
  touch_news last{stroke_of_organ{}(0.0), vector::Zero()};
  while (!with.over) {
    if (const auto* news = with.touches.take()) last = *news;
    if (vector(last.force).squaredNorm() > vector(with.hardest.force).squaredNorm()) {
      with.hardest = last;
    }
    const double begin = thread_cpu();
    body.update(last.device, last.force);
    with.surfaces.publish(published<Surface>(body));
    with.update_cpu += thread_cpu() - begin;
    ++with.updates;
    static_cast<void>(pace.next());
  }
  with.environment_cpu = thread_cpu();
}

constexpr std::size_t kept = std::size_t{1} << 16;  // ticks: the last minute
ph::scope<volume, kept> seen;
std::array<double, kept> port_energy;    // true, of the same ticks [J]
std::array<double, kept> asked_force;    // of the newest surface, its stiffness times the depth [N]
constexpr std::size_t ticks_a_row = 10;  // of what is drawn
std::vector<double> true_force;          // of its rows [N]

double unsettled = 0.0;  // the last change of any of them while it was solved [N]

/// What a body that answers in every tick pushes with where the device has been: the same spring on the same body, which
/// is solved there until it rests. Throws ex::interrupted if `tell` says so.
template <class Body>
void find_true_force(Body& body, const env::on_progress& tell) {
  constexpr int updates = 4;  // each loads what the last has found
  true_force.clear();
  unsettled = 0.0;
  vector now = vector::Zero();
  for (std::size_t i = 0; i < seen.size(); i += ticks_a_row) {
    vector before = now;
    for (int k = 0; k < updates; ++k) {
      const auto& contact = body.update(seen[i].position, now);
      before = now;
      now = contact.stiffness * std::max(0.0, contact.depth) * contact.normal;
    }
    unsettled = std::max(unsettled, (now - before).norm());
    true_force.push_back(now.norm());
    if (tell && !tell(double(i) / double(seen.size()))) {
      throw ex::interrupted("stopped: there is no report");
    }
  }
}

/// Touches the body, and returns what came of it.
template <class Surface, class Body>
chain_row touch(Body& body, const chain_settings& chosen, const env::on_progress& tell) {
  meeting<Surface> with;
  body.update(stroke_of_organ{}(0.0), vector::Zero());
  with.surfaces.publish(published<Surface>(body));
  ph::passive_port port{
      volume{}, one_contact<Surface>(mass, force_limit), ph::reduced_energy{.damping = damping},
      ph::bound_chain{
          ph::reachable_bound{.mass = mass, .hand_force = 1.25 * stroking_hand::strongest},
          ph::actuator_limit{.most = force_limit}},
      ph::late_loop_limits<1>{.longest_tick = chosen.longest_tick,
                              .watchdog = chosen.longest_tick}};
  if (const auto fault = port.check()) {
    throw std::invalid_argument(std::string("the chain's ") + fault.parameter + " must be " +
                                fault.remedy);
  }
  seen.clear();
  std::uint64_t tick = 0;
  living_device device(chosen.longest_tick, chosen.seconds);
  sim::quiet_judge<volume> judge;
  std::vector<vector> room;
  room.reserve(1);
  ph::runner loop{device, [&](const auto& sample) {
                    if (const auto* surface = with.surfaces.take())
                      port.source().update(0, *surface);
                    const auto done = port.tick(sample);
                    with.touches.publish({sample.position, done.force});
                    const double now = device.body().time();
                    if (now < chosen.seconds) {
                      seen.record(sample, done);
                    } else {
                      judge.add(done.force, device.body().velocity(), sample.dt,
                                ex::pressing(port.source(), 1, room));
                    }
                    if (now < chosen.seconds) {
                      port_energy[tick % kept] = device.body().meter().value();
                      asked_force[tick % kept] = port.source().slot(0).target().stiffness *
                                                 std::max(0.0, double(done.depth));
                    }
                    ++tick;
                    if (tick % 128 == 0) with.haptic_cpu = thread_cpu();
                    return done.force;
                  }};
  std::thread environment([&] { answer_touches(body, with, chosen.rate); });
  const auto started = loop.start({.priority = 80, .lock_memory = true});
  const double end = chosen.seconds + ex::quiet_watched;
  bool go_on = static_cast<bool>(started);
  for (double t = 0.0; t < end && go_on; t += 0.1) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    go_on = loop.running() && (!tell || tell(t / end));
  }
  loop.stop();
  with.over = true;
  environment.join();
  if (!started) throw std::runtime_error(ph::to_string(started.what));
  if (!go_on) throw ex::interrupted("stopped: there is no report");
  find_true_force(body, tell);
  body.update(with.hardest.device, with.hardest.force);  // what is drawn
  std::array<char, 600> text{};
  std::cout << ph::describe(started.granted, text) << '\n'
            << ph::describe(loop.timing(), text) << "\n\n";

  chain_row row{.surface = name_of<Surface>,
                .seconds = device.body().time(),
                .updates = with.updates,
                .update = 1e3 * with.update_cpu / static_cast<double>(with.updates),
                .ticks = loop.counts().ticks,
                .late = loop.counts().late,
                .lost = loop.counts().lost,
                .longest = 1e-6 * static_cast<double>(loop.counts().longest.count()),
                .least_energy = device.body().meter().minimum(),
                .missing = std::abs(device.body().residual()),
                .haptic_cpu = 100.0 * with.haptic_cpu / device.body().time(),
                .environment_cpu = 100.0 * with.environment_cpu / device.body().time()};
  const auto force = [&port](const vector& x) -> vector {
    return port.tick(x, ph::seconds{1e-3}).force;
  };
  const double asked = port.source().slot(0).target().stiffness;
  row.still.add(judge, {asked, ex::shown_by(force, vector(device.body().position()))});
  std::size_t counted = 0, touching = 0;
  double after_late = 1.0;  // time since the last tick that was longer than stated [s]
  for (std::size_t i = 1; i < seen.size(); ++i) {
    const auto& now = seen[i];
    row.beyond += now.dt > chosen.longest_tick ? 1U : 0U;
    const vector given = now.given, before = seen[i - 1].given;
    row.largest_force = std::max(row.largest_force, given.norm());
    after_late = now.dt > chosen.longest_tick ? 0.0 : after_late + now.dt;
    double& step = now.time < first_second ? row.touch_step
                   : after_late < 0.01     ? row.late_step
                                           : row.largest_step;
    step = std::max(step, (given - before).norm());
    if (now.time < first_second) continue;
    ++counted;
    touching += now.depth > 0.0 ? 1U : 0U;
  }
  row.contact = counted > 0 ? 100.0 * static_cast<double>(touching) / static_cast<double>(counted)
                            : std::nan("");
  return row;
}

template <class Body>
chain_row touch_by(const std::string& by, Body& body, const chain_settings& chosen,
                   const env::on_progress& tell) {
  chain_row row =
      chosen.planes ? touch<plane>(body, chosen, tell) : touch<quadric>(body, chosen, tell);
  row.by = by;
  return row;
}

/// The upper side of a body in millimetres, coloured by how far it has moved.
void draw_surface(ex::report& out, const held_mesh& body, const std::vector<vector>& now) {
  ex::csv_file csv(out.path("chain_surface.csv"), "x mm,y mm,z mm,moved mm");
  for (const auto& t : env::boundary(body.mesh)) {
    const env::triangle shape = env::corners(t, now);
    if (env::area_vector(shape).z() <= 0.0) continue;
    const auto corner = [&](std::size_t k) {
      const vector x = 1e3 * shape[k];
      const auto node = env::slot(t.nodes[k]);
      csv.row(x.x(), x.y(), x.z(), 1e3 * (now[node] - body.mesh.nodes[node]).norm());
    };
    corner(0);
    corner(1);
    csv.line("");
    corner(2);
    corner(2);
    csv.line("\n");
  }
  csv.close();
  out.plot("chain_surface",
           {"The upper side of the organ where the tool pressed hardest",
            {{"Coloured by how far it has moved.", "chain_surface.csv",
              [](const ex::recorded& r) {
                double most = 0.0;  // lines between the triangles have no number
                for (const double mm : r["moved mm"])
                  most = std::isfinite(mm) ? std::max(most, mm) : most;
                return ex::at_least(most, 0.1);
              }},
             {"Its file for ParaView is chain_organ.vtu.",
              [&out] { return std::filesystem::exists(out.path("chain_organ.vtu")); }},
             ex::definition("All three axes have one scale; none is drawn.")}},
           "set key noautotitle\nset pm3d depthorder\nset view 50,30,1.7\n"
           "set view equal xyz\nunset border\nunset xtics\nunset ytics\nunset ztics\n"
           "set palette defined (0 '#d8c9b4', 0.3 '#d88060', 1 '#901010')\n"
           "set cblabel 'moved [mm]'\n"
           "splot 'chain_surface.csv' using 1:2:3:4 with pm3d");
}

void draw_course(ex::report& out) {
  if (!ph::save(seen, out.path("chain_scope.csv").c_str())) {
    throw std::runtime_error("chain_scope.csv cannot be written");
  }
  ex::csv_file csv(out.path("chain_course.csv"),
                   "s,force N,step N,depth mm,port energy J,ledger J,on time,asked N,truth N");
  const std::uint64_t first = seen.size() > 0 ? seen[0].tick : 0;
  std::size_t on_time = 0;  // ticks since the last one that was late
  double step = 0.0;        // largest of a row's ticks [N]
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto& r = seen[i];
    on_time = r.dt > late ? 0 : on_time + 1;
    if (i > 0) step = std::max(step, (vector(r.given) - vector(seen[i - 1].given)).norm());
    if (i % ticks_a_row != 0) continue;
    csv.row(r.time, vector(r.given).norm(), step, 1e3 * r.depth, port_energy[(first + i) % kept],
            r.energy, on_time > 100 + ticks_a_row ? 1 : 0, asked_force[(first + i) % kept],
            true_force.at(i / ticks_a_row));
    step = 0.0;
  }
  csv.close();
  out.plot(
      "chain_force",
      {"The force on the device",
       {{"The truth has settled within a hundredth of its largest force.", "chain_course.csv",
         [](const ex::recorded& r) {
           return ex::at_most(unsettled / ex::most(r["truth N"]), 1e-2);
         }},
        {"The force is off it by less than a fifth, rms.", "chain_course.csv",
         [](const ex::recorded& r) {
           const auto& truth = r["truth N"];
           return ex::at_most(ex::rms_between(r["force N"], truth),
                              0.2 * ex::rms_between(truth, std::vector(truth.size(), 0.0)));
         }},
        ex::definition("Drawn with it is what the newest surface asks for, its stiffness times the "
                       "depth."),
        {"After the first second, in which the hand comes, it changes by less than 0.1 N from tick "
         "to tick, the tenth of a second after a late one left out.",
         "chain_course.csv",
         [](const ex::recorded& r) {
           const auto &s = r["s"], &steps = r["step N"], &fit = r["on time"];
           double most = 0.0;
           for (std::size_t i = 0; i < steps.size(); ++i) {
             if (s[i] >= first_second && fit[i] > 0.0) most = std::max(most, steps[i]);
           }
           return ex::at_most(most, 0.1);
         }},
        {"A spike down to zero comes with a late tick,", "chain_course.csv",
         [](const ex::recorded& r) {
           const auto &s = r["s"], &force = r["force N"], &wanted = r["asked N"],
                      &fit = r["on time"];
           for (std::size_t i = 0; i < s.size(); ++i) {
             if (s[i] >= first_second && wanted[i] > 0.1 && force[i] == 0.0 && fit[i] > 0.0)
               return false;
           }
           return true;
         }},
        ex::definition("in which the device's watchdog drops the force.")},
       {"chain_course.csv", "truth N",
        "what the organ pushes with, solved at rest wherever the device has been"}},
      "set xlabel 's'\nset ylabel 'N'\nset yrange [0:*]\n"
      "plot 'chain_course.csv' using 1:8 with lines lt 2, '' using 1:2 with lines lt 1");
  out.plot("chain_energy",
           {"Energy that the hand has paid in: true, and in the ledger",
            {{"The ledger stays below the truth, as it must,", "chain_course.csv",
              [](const ex::recorded& r) {
                const auto &truth = r["port energy J"], &ledger = r["ledger J"];
                double above = -1.0;
                for (std::size_t i = 0; i < truth.size(); ++i) {
                  above = std::max(above, ledger[i] - truth[i]);
                }
                return ex::at_most(above, 1e-9);
              }},
             {"and neither falls below zero: nothing came out that the hand had not put in.",
              "chain_course.csv",
              [](const ex::recorded& r) {
                return ex::at_least(
                    std::min(ex::least(r["port energy J"]), ex::least(r["ledger J"])), -1e-12);
              }}}},
           "set xlabel 's'\nset ylabel 'J'\nset yrange [0:*]\nplot 'chain_course.csv' using 1:5 "
           "with lines, '' using 1:6 with lines");
}

}  // namespace

ex::record record_of(const chain_row& r) {
  return ex::with({{"nodes", r.nodes},
                   {"by", r.by},
                   {"surface", r.surface},
                   {"seconds", r.seconds},
                   {"updates", r.updates},
                   {"update_ms", r.update},
                   {"ticks", r.ticks},
                   {"late", r.late},
                   {"lost", r.lost},
                   {"longest_ms", r.longest},
                   {"beyond_stated", r.beyond},
                   {"contact_%", r.contact, "%.4g"},
                   {"largest_force_N", r.largest_force},
                   {"step_at_touch_N", r.touch_step},
                   {"step_when_late_N", r.late_step},
                   {"largest_step_N", r.largest_step},
                   {"least_energy_J", r.least_energy},
                   {"missing_J", r.missing, "%.1e"},
                   {"haptic_cpu_%", r.haptic_cpu},
                   {"environment_cpu_%", r.environment_cpu}},
                  r.still);
}

chain_row run_chain(ex::report& out, const chain_settings& chosen, const env::on_progress& tell) {
  const held_mesh body = make_organ(chosen.side);
  const auto stroked = stroked_patch(body);
  env::tetrahedral_fem fem(body.mesh, organ_flesh, body.held, {.tell = tell, .touched = stroked});
  const env::body_options around{.radius = fingertip, .moved = env::moved_nodes::around};
  chain_row row;
  std::vector<vector> now = body.mesh.nodes;  // all of them, where the tool presses hardest
  if (chosen.by_table) {
    const auto id = env::fingerprint_of(body.mesh, organ_flesh, body.held);
    const auto file = out.path(ex::format("organ_%.0f.table", double(chosen.side)));
    if (env::load_table(file, id, body.mesh.nodes.size()).fault) {
      env::compute_table(file, fem, id, stroked, {.threads = chosen.threads, .tell = tell});
    }
    env::basic_deformable_body<env::compliance_table<>> touched(
        body.mesh, env::read_table(file, id, body.mesh.nodes.size()), around);
    row = touch_by("table", touched, chosen, tell);
    const auto& last = touched.contact();  // the table knows its patch alone
    env::contact_area area(touched.search(), body.mesh.nodes);
    area.gather(touched.search(), body.mesh.nodes, touched.surface()[env::slot(last.triangle)],
                last.weights, fingertip);
    fem.press(area.nodes(), area.shares());
    fem.load(-touched.force());
    for (std::size_t i = 0; i < now.size(); ++i) now[i] += fem.displacement(static_cast<int>(i));
  } else {
    env::basic_deformable_body<env::tetrahedral_fem> touched(body.mesh, std::move(fem), around);
    row = touch_by("elimination path", touched, chosen, tell);
    now = touched.picture();
  }
  row.nodes = body.mesh.nodes.size();
  env::write_vtu(out.path("chain_organ.vtu"), body.mesh, now);
  out.section(
      "The whole chain",
      "Real threads: an organ of finite elements at its own rate, a loop of 1 kHz, a device "
      "of 0.25 kg and 1 N·s/m in a hand of at most 4 N that strokes the organ. The device's "
      "watchdog is the longest tick that was stated. Late are ticks of more than 1.5 ms; "
      "CPU is that of a core. Then the hand stops and holds still for 6 s, while the organ goes on "
      "answering, so a force that the watchdog drops in a late tick is not quiet." +
          std::string(ex::quiet_columns));
  ex::show_rows(out, "chain", std::vector{row});
  draw_surface(out, body, now);
  draw_course(out);
  return row;
}

}  // namespace organ
