// SPDX-License-Identifier: BSD-3-Clause
#include "touch.hpp"

#include "../thesis_experiments/ball.hpp"
#include "../thesis_experiments/organ.hpp"
#include "../thesis_experiments/tangent_plane.hpp"
#include "compose_touch.hpp"
#include <passive_haptics/environment/ball.hpp>

#include <memory>

namespace experiments {
namespace {

answer from_body(const env::surface_contact& c) {
  const auto at_rest = env::yielding(tangent_plane(c), c);
  return {c.nodes, c.point, c.normal, c.stiffness, at_rest.point, at_rest.stiffness};
}

/// A deformable body as an environment.
template <class Mesh, class Fixed>
std::function<answer(const vector3&, const vector3&)> body_of(const Mesh& mesh,
                                                              const env::material& flesh,
                                                              const Fixed& fixed) {
  const auto body = std::make_shared<env::deformable_body>(mesh, flesh, fixed);
  return [body](const vector3& device, const vector3& held) {
    return from_body(body->update(device, held));
  };
}

}  // namespace

touch_scene yielding_wall() {
  const double pi = std::acos(-1.0);
  const auto hand = [pi](double t) {
    const double depth = 3e-3 - 2e-3 * std::cos(2.0 * pi * t) + 2e-4 * std::sin(16.0 * pi * t);
    return vector3(0.0, 0.0, -depth);
  };
  const auto fresh = [] {
    // Relaxed towards F/K_VE, or the two springs would swing against each other (A12).
    return [force = 0.0](const vector3& /*device*/, const vector3& held) mutable {
      constexpr double local = 1e3, far = 2e3;  // [N/m]
      force += far / (far + local) * (held.z() - force);
      const double surface = -force / far;
      return answer{{},    {0.0, 0.0, surface}, vector3::UnitZ(),
                    local, vector3::Zero(),     local * far / (local + far)};
    };
  };
  return {"wall", 1, 3.0, 0.5, 3.0, hand, fresh};
}

touch_scene soft_ball() {
  const double pi = std::acos(-1.0);
  const auto hand = [pi](double t) {
    const double angle = 0.35 * std::sin(pi * t);  // over several faces
    const double radius = ball_radius * (0.80 + 0.03 * std::cos(4.0 * pi * t));
    return vector3(radius * std::sin(angle), 0.007, radius * std::cos(angle));
  };
  const auto fresh = [] {
    return body_of(env::ball(ball_radius), ball_material, env::ball_fixed_nodes());
  };
  return {"ball", 3, 3.0, 0.5, 3.0, hand, fresh};
}

touch_scene stroked_organ() {
  const auto scene = std::make_shared<stroke_scene>(read_organ(our_organ, millimetre));
  const auto hand = [scene](double t) { return scene->position(t); };
  const auto fresh = [scene] { return body_of(scene->mesh(), flesh, scene->fixed()); };
  return {"mesh",
          3,
          stroke_scene::total,
          stroke_scene::approach + 0.1,
          stroke_scene::approach + stroke_scene::stroke,
          hand,
          fresh};
}

model_error error_of(const touch_scene& scene, const felt& run, const felt& truth) {
  model_error error;
  double force = 0.0, depth = 0.0;
  int count = 0;
  for (std::size_t n = 1; n < run.force.size(); ++n) {
    const double t = 1e-3 * static_cast<double>(n);
    if (t < scene.from || t > scene.to) continue;
    const double off = (run.force[n] - truth.force[n]).norm();
    force += off * off;
    depth += (run.depth[n] - truth.depth[n]) * (run.depth[n] - truth.depth[n]);
    error.largest_force = std::max(error.largest_force, off);
    error.largest_step = std::max(error.largest_step, (run.force[n] - run.force[n - 1]).norm());
    ++count;
  }
  error.rms_force = std::sqrt(force / count);
  error.rms_depth = std::sqrt(depth / count);
  return error;
}

felt truth_of(const touch_scene& scene) {
  const auto bare = []<class Space>(Space) {
    return ph::local_model{Space{},
                           ph::followed<ph::half_space<Space>>{},
                           ph::turn_at_once{},
                           ph::spring{},
                           ph::no_observer{},
                           ph::no_bound{},
                           loop};
  };
  if (scene.dof == 1) return run_touch(bare(ph::space<double, 1>{}), scene, 1e-4, 1e-4);
  return run_touch(bare(volume{}), scene, 1e-4, 1e-4);
}

const std::vector<composition>& all_compositions() {
  static const std::vector<composition> all = [] {
    std::vector<composition> every;
    compose_walls(every);
    compose_planes(every);
    compose_triangles(every);
    return every;
  }();
  return all;
}

}  // namespace experiments
