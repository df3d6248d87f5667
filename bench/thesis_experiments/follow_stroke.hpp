// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One run of a local model along the stroke.

#include "strokes.hpp"
#include "tangent_plane.hpp"
#include <passive_haptics/simulation/loop.hpp>
#include <passive_haptics/simulation/prescribed_motion.hpp>
#include <passive_haptics/simulation/schedule.hpp>

#include <algorithm>
#include <chrono>

namespace experiments {

struct as_it_is {
  auto operator()(env::deformable_body& body, const vector3& finger, const vector3& force) const {
    return tangent_plane(body.update(finger, force));
  }
};

/// The environment answers every `period` [s]; the model is told ask(body, finger [m], force [N]).
template <class Model, class Ask = as_it_is>
stroke_result follow_stroke(Model model, const stroke_scene& scene, double period, Ask ask = {}) {
  env::deformable_body body(scene.mesh(), flesh, scene.fixed());
  sim::prescribed_motion<volume> device({.start = scene.position(0.0)});
  sim::update_schedule schedule(1, period, period);
  stroke_result result;
  vector3 last = vector3::Zero();
  const auto answer = [&](const auto& now) {
    if (!schedule.due(now.time)) return;
    const auto begin = std::chrono::steady_clock::now();
    const auto news = ask(body, now.sample.position, now.sample.held);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    result.update_ms.push_back(took.count());
    model.update(news);
  };
  const auto move = [&](const auto& now) {
    const vector3 &x = now.position, &f = now.force;
    result.force_step = std::max(result.force_step, (f - last).norm());
    last = f;
    if (stroke_scene::stroking(now.time) && f.norm() == 0.0) ++result.contact_lost;
    result.forces.push_back(f);
    result.rows.push_back({now.time, x(0), x(1), x(2), f(0), f(1), f(2), f.norm(), now.out.depth,
                           now.out.energy, device.meter().value()});
    device.move_to(scene.position(now.time + 1e-3));
  };
  const int ticks = static_cast<int>(stroke_scene::total * 1000.0);
  result.port_energy = sim::run(device, model, ticks, answer, move).least_energy;
  result.end_energy = device.meter().value();
  return result;
}

}  // namespace experiments
