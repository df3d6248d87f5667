// SPDX-License-Identifier: BSD-3-Clause
#include "precision.hpp"

#include "../common/pareto.hpp"
#include "published.hpp"
#include <passive_haptics/environment/compliance_table.hpp>
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/simulation/schedule.hpp>

namespace organ {

namespace sim = passive_haptics::simulation;

namespace {

using touched_body = env::basic_deformable_body<env::compliance_table<>>;

constexpr double counted_from = 1.0;  // the hand has arrived [s]
constexpr double often = 1e4;         // as good as always [Hz]

/// A mesh whose table is on disk: bodies of it, at rest.
struct organ_of {
  held_mesh body;
  std::filesystem::path file;
  std::uint64_t id;
  double radius = fingertip;
  [[nodiscard]] touched_body fresh() const {
    return {body.mesh, env::read_table(file, id, body.mesh.nodes.size()),
            env::body_options{.radius = radius, .moved = env::moved_nodes::around}};
  }
};

/// Every millisecond of a stroke that counts.
struct felt {
  std::vector<vector> force;  ///< [N]
  double update = 0.0;        ///< CPU time, mean [s]
  double stiffness = 0.0;     ///< mean [N/m]
  double edge = 0.0;          ///< mean [m]
  double largest_step = 0.0;  ///< [N]
};

/// The stroke in virtual time, the body solved `rate` times a second.
template <class Surface>
felt stroke(const organ_of& which, auto model, double rate, double seconds) {
  auto body = which.fresh();
  const double tick = rate >= often ? 1.0 / often : 1e-3;
  const stroke_of_organ hand;
  sim::prescribed_motion<volume> device({.period = tick, .start = hand(0.0)});
  sim::update_schedule schedule(1, 1.0 / rate, 1.0 / rate);
  const int each = static_cast<int>(1e-3 / tick + 0.5);
  felt run;
  int updates = 0;
  vector last = vector::Zero();
  const auto answer = [&](const auto& now) {
    if (!schedule.due(tick * now.tick + tick / 2.0)) return;
    const double begin = thread_cpu();
    const auto contact = body.update(now.sample.position, now.sample.held);
    const Surface surface = published<Surface>(body);
    run.update += thread_cpu() - begin;
    run.stiffness += contact.stiffness;
    run.edge += std::sqrt(env::area_vector(contact.nodes).norm());  // of half a square
    ++updates;
    model.update(surface);
  };
  const auto move = [&](const auto& now) {
    if (now.tick % each == 0) {
      if (tick * now.tick >= counted_from) {
        run.largest_step = std::max(run.largest_step, (now.force - last).norm());
        run.force.push_back(now.force);
      }
      last = now.force;
    }
    device.move_to(hand(tick * (now.tick + 1)));
  };
  sim::run(device, model, static_cast<int>(seconds / tick + 0.5), answer, move);
  for (double* mean : {&run.update, &run.stiffness, &run.edge}) *mean /= updates;
  return run;
}

/// A set of one contact under no bound, so that nothing but the surface is judged.
template <class Surface>
struct free_port : ph::passive_port<volume, decltype(one_contact<Surface>(1.0, 1.0)),
                                    ph::no_observer, ph::no_bound, ph::loop_limits> {
  free_port()
      : ph::passive_port<volume, decltype(one_contact<Surface>(1.0, 1.0)), ph::no_observer,
                         ph::no_bound, ph::loop_limits>{volume{},
                                                        one_contact<Surface>(0.25, 9.0),
                                                        {},
                                                        {},
                                                        ph::loop_limits{.longest_tick = 1e-3}} {}
  void update(const Surface& next) { this->source().update(0, next); }
};

/// The triangles themselves, solved all the time: what the other runs are measured by.
felt truth_of(const organ_of& which, double seconds) {
  return stroke<plane>(
      which,
      ph::local_model{volume{}, ph::followed<plane>{}, ph::turn_at_once{}, ph::spring{},
                      ph::no_observer{}, ph::no_bound{}, ph::loop_limits{.longest_tick = 1e-3}},
      often, seconds);
}

double rms(const felt& run, const felt* from = nullptr) {
  double sum = 0.0;
  for (std::size_t i = 0; i < run.force.size(); ++i) {
    sum += (from != nullptr ? vector(run.force[i] - from->force[i]) : run.force[i]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(run.force.size()));
}

template <class Surface>
void judge(std::vector<precision_row>& rows, const organ_of& which, const felt& truth,
           const precision_settings& chosen) {
  const felt own = stroke<Surface>(which, free_port<Surface>{}, often, chosen.seconds);
  for (const double rate : chosen.rates) {
    const felt run = stroke<Surface>(which, free_port<Surface>{}, rate, chosen.seconds);
    rows.push_back({.nodes = which.body.mesh.nodes.size(),
                    .surface = name_of<Surface>,
                    .rate = rate,
                    .update = 1e3 * run.update,
                    .work = 1e3 * run.update * rate,
                    .force = rms(truth),
                    .error = rms(run, &truth),
                    .share = 100.0 * rms(run, &truth) / rms(truth),
                    .own = rms(run, &own),
                    .own_share = 100.0 * rms(run, &own) / rms(truth),
                    .largest_step = run.largest_step});
  }
}

/// Marks what nothing beats in work and in that error, and draws all of them.
void plot(ex::report& out, std::vector<precision_row>& rows, const std::string& name,
          const std::string& from, double precision_row::*share, bool precision_row::*front) {
  std::vector<std::pair<double, double>> points;
  for (const auto& r : rows) points.emplace_back(r.work, r.*share);
  ex::csv_file csv(out.path(name + "_front.csv"), "work ms,error %");
  for (const std::size_t i : ex::pareto_front(points)) {
    rows[i].*front = true;
    csv.row(rows[i].work, rows[i].*share);
  }
  csv.close();
  const std::string column = share == &precision_row::share ? "8" : "10";
  std::string marks;
  int style = 4;
  for (const char* surface : {name_of<plane>, name_of<quadric>, name_of<patch>}) {
    marks += "'precision.csv' using (stringcolumn(2) eq '" + std::string(surface) +
             "' ? $5 : NaN):" + column + ":(log10($1)/3) with points pt " + std::to_string(style) +
             " ps variable title '" + surface + "', ";
    style += 2;
  }
  out.plot(name,
           {"Error of the force over the work that it costs, from " + from + " at 10 kHz",
            {ex::definition(
                 "The rms error in percent of the force over the CPU time of all updates of a "
                 "second; larger marks are finer meshes."),
             {"What lies on the line has no rival that is both cheaper and better.",
              name + "_front.csv", ex::joins_unbeaten("work ms", "error %", points)}}},
           "set logscale xy\nset xlabel 'CPU time of the updates [ms a second]'\n"
           "set ylabel 'rms force error [%]'\nplot " +
               marks + "'" + name +
               "_front.csv' using 1:2 with steps lw 2 lc rgb '#555555' title 'Pareto front'");
}

}  // namespace

ex::record record_of(const precision_row& r) {
  return {{"nodes", r.nodes},
          {"surface", r.surface},
          {"rate_Hz", r.rate},
          {"update_ms", r.update},
          {"work_ms_per_s", r.work},
          {"force_N", r.force},
          {"error_N", r.error},
          {"error_%", r.share},
          {"own_N", r.own},
          {"own_%", r.own_share},
          {"largest_step_N", r.largest_step},
          {"front", r.front},
          {"own_front", r.own_front}};
}
ex::record record_of(const mesh_row& r) {
  return {{"nodes", r.nodes},
          {"edge_mm", r.edge},
          {"stiffness_N_per_m", r.stiffness},
          {"of_a_point_N_per_m", r.of_point},
          {"force_N", r.force},
          {"error_N", r.error},
          {"largest_step_N", r.largest_step}};
}

precision_result run_precision(ex::report& out, const precision_settings& chosen,
                               const env::on_progress& tell) {
  precision_result all;
  std::vector<felt> truths;
  ex::progress bar("precision", static_cast<int>(chosen.sides.size()));
  for (const int side : chosen.sides) {
    organ_of which{make_organ(side), out.path(ex::format("organ_%.0f.table", double(side))), 0};
    const held_mesh& body = which.body;
    which.id = env::fingerprint_of(body.mesh, organ_flesh, body.held);
    if (env::load_table(which.file, which.id, body.mesh.nodes.size()).fault) {
      const auto stroked = stroked_patch(body);
      const env::tetrahedral_fem fem(body.mesh, organ_flesh, body.held,
                                     {.tell = tell, .touched = stroked});
      env::compute_table(which.file, fem, which.id, stroked,
                         {.threads = chosen.threads, .tell = tell});
    }
    truths.push_back(truth_of(which, chosen.seconds));
    const felt& truth = truths.back();
    organ_of pricked = which;
    pricked.radius = 0.0;
    all.meshes.push_back({.nodes = body.mesh.nodes.size(),
                          .edge = 1e3 * truth.edge,
                          .stiffness = truth.stiffness,
                          .of_point = truth_of(pricked, chosen.seconds).stiffness,
                          .force = rms(truth),
                          .largest_step = truth.largest_step});
    judge<plane>(all.rows, which, truth, chosen);
    judge<quadric>(all.rows, which, truth, chosen);
    judge<patch>(all.rows, which, truth, chosen);
    if (tell && !tell(0.0)) throw ex::interrupted("stopped: there is no report");
    bar.step();
  }
  for (std::size_t i = 0; i < truths.size(); ++i) {
    all.meshes[i].error = rms(truths[i], &truths.back());
  }
  out.section(
      "Error against run time",
      "The organ is stroked 2 to 4 mm deep by a fingertip of 10 mm radius that goes where it "
      "wants, in virtual time; its contact is solved so many times a second, from a table, and "
      "published as a plane, a quadric or a patch to a set of one contact under no bound. error: "
      "rms from the triangles of the same mesh solved at 10 kHz; own: from the same surface at "
      "10 kHz, so without what smoothing makes. Front: nothing has less of that error for as "
      "little "
      "work. Work is the CPU time of the updates a second.");
  plot(out, all.rows, "precision", "the triangles of the same mesh", &precision_row::share,
       &precision_row::front);
  plot(out, all.rows, "precision_own", "the same surface", &precision_row::own_share,
       &precision_row::own_front);
  ex::publish(out, "precision", all.rows);
  out.section("The meshes themselves",
              "Each at 10 kHz, against the finest one. Under a fingertip of 10 mm a finer mesh is "
              "softer by less and less; a point would sink into it ever deeper.");
  ex::publish(out, "meshes", all.meshes);
  return all;
}

}  // namespace organ
