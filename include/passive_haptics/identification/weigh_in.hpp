// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Weighs a known mass with the motors: how many newtons does an axis deliver for each newton commanded?
//
//     const std::vector<weighed_pose<3>> poses{{.pulls = {1, 0, 0}}, {.pulls = {0, 1, 0}}, {.pulls = {0, 0, 1}}};
//     const auto found = weigh<scene>(device, weigh_in<3>({.mass = 0.2}, poses), ready, stop);
//     if (found.problem) std::puts(found.problem);
//     known_gains<scene, my_device> grip{device, found.likely, found.tolerance(true)};        // known_gains.hpp
//
// ready(sentence) shows what is to be done, and says once a tick whether it has been. Each pose is weighed three times:
// with nothing hung on the handle, with the mass, with nothing again. What the mass changes is d = w/g, w = m g₀ along
// the axis; over the poses least squares have 1/g = Σ w d/Σ w². Cogging is that of the same way, with the mass and
// without (weighed_axis.hpp). Motors behind a linkage are told Jᵀ of each pose: then Jᵀd and Jᵀw take the places of d
// and w, and g is that of a motor.
//
// d is known to 4.5 deviations of the mean of eight cycles (Student's t is beyond that once in 360), half of what the
// device without the mass has changed by, and a hundredth of its friction, which may depend on the load. The weight is
// known to `mass_tolerance`.

#include <passive_haptics/identification/describe.hpp>
#include <passive_haptics/identification/device_file.hpp>
#include <passive_haptics/identification/identify.hpp>
#include <passive_haptics/identification/known_gains.hpp>
#include <passive_haptics/identification/weighed_axis.hpp>

#include <utility>
#include <vector>

namespace passive_haptics {
inline namespace v0 {
namespace identification {

/// In metres and newtons; at a joint `force` is in newton metres, `moves` in kg·m² and `way` in radians.
struct weigh_in_parameters {
  double mass = 0.0;  ///< what is hung on the handle [kg]
  double mass_tolerance =
      0.005;           ///< of its weight; over the earth alone that differs by 0.003 either way
  double force = 3.0;  ///< largest force that is ever commanded on an axis [N]
  double moves = 0.1;  ///< mass of an axis, roughly, as identified [kg]
  double way = 3e-3;   ///< how far it goes to either side [m]
  double precision = 0.05;  ///< largest error of 1/g, as a share, that is worth stating

  [[nodiscard]] constexpr parameter_fault check() const noexcept {
    using passive_haptics::detail::positive;
    if (!positive(mass)) return {"mass", mass, "finite and > 0 kg"};
    if (!(mass_tolerance >= 0.0 && mass_tolerance <= 0.2)) {
      return {"mass_tolerance", mass_tolerance, "0 to 0.2"};
    }
    if (!positive(force)) return {"force", force, "finite and > 0 N"};
    if (!positive(moves)) return {"moves", moves, "finite and > 0 kg"};
    if (!positive(way)) return {"way", way, "finite and > 0 m"};
    if (!(precision > 0.0 && precision <= 0.3)) return {"precision", precision, "> 0, up to 0.3"};
    return {};
  }
};

template <int Dof>
using axis_numbers = std::array<double, static_cast<std::size_t>(Dof)>;

template <int Dof>
struct weighed_pose {
  axis_numbers<Dof>
      pulls{};  ///< where the weight pulls: a unit vector; at joints the arms [m], Jᵀ times that
  std::array<axis_numbers<Dof>, static_cast<std::size_t>(Dof)>
      rows{};  ///< Jᵀ: motor i has rows[i]·f; 0: has fᵢ
};

/// Newtons delivered for each newton commanded, by axis, or by motor where `rows` are stated.
template <int Dof>
struct gains_found {
  axis_numbers<Dof> likely{}, least{}, most{};
  double friction = 0.0,
         spread = 0.0;      ///< the largest of any axis, and the largest deviation of a cycle [N]
  double least_mass = 0.0;  ///< that would have been precise enough [kg]
  const char* problem = nullptr;

  /// The share by which a gain may differ from 1, or from `likely` if the commands are divided by that.
  [[nodiscard]] double tolerance(bool divided) const noexcept {
    double share = 0.0;
    for (std::size_t i = 0; i < likely.size(); ++i) {
      const double by = divided ? likely[i] : 1.0;
      share = (std::max)({share, most[i] / by - 1.0, 1.0 - least[i] / by});
    }
    return share;
  }
};

/// A line for each axis, and what to do with it.
template <int Dof>
[[nodiscard]] std::string table_of(const gains_found<Dof>& found) {
  using detail::text;
  const std::string hang = text("  at least %.3f kg would do\n", found.least_mass);
  if (found.problem != nullptr) {
    return std::string("  ") + found.problem + '\n' + (found.least_mass > 0.0 ? hang : "");
  }
  std::string all;
  for (std::size_t i = 0; i < found.likely.size(); ++i) {
    all += text("  gain %.0f   %.4f N for each newton commanded, %.4f to %.4f\n",
                static_cast<double>(i + 1), found.likely[i], found.least[i], found.most[i]);
  }
  all += text("  friction on the way up to %.3f N, cycles differ by up to %.4f N\n", found.friction,
              found.spread);
  return all + hang +
         text("  Divide the commands by these: %.1f %% of tolerance are left of %.1f %%.\n",
              100.0 * found.tolerance(true), 100.0 * found.tolerance(false));
}

/// The description of a device with the gains that were found, for save_device().
template <int Dof>
[[nodiscard]] device_description weighed(device_description of, const gains_found<Dof>& found) {
  of.gains.assign(found.likely.begin(), found.likely.end());
  of.gain_tolerance = found.tolerance(true);
  return of;
}

/// Tick by tick. It allocates when it is made.
template <int Dof>
class weigh_in {
 public:
  using numbers = axis_numbers<Dof>;

  weigh_in(const weigh_in_parameters& p, std::vector<weighed_pose<Dof>> poses)
      : p_(p), poses_(std::move(poses)), known_(poses_.size()) {
    if (p_.check()) fail("a parameter is out of its range: ask weigh_in_parameters::check()");
    bool pulls = !poses_.empty();
    for (const auto& pose : poses_) {
      const double squares = dot(pose.pulls, pose.pulls);
      pulls = pulls && squares > 0.0 && kernels::is_finite(squares);
    }
    if (!pulls) fail("a pose has no direction in which the mass pulls: state one");
  }

  /// Takes the positions [m] at the end of a tick of that length [s], and returns the forces [N] for the next one: 0 once
  /// it is done(), while it waits for a pose, and where a number is not finite.
  numbers tick(const numbers& x, seconds<double> length) noexcept {
    const double dt = length.count();
    bool good = passive_haptics::detail::positive(dt), weighed = !waits_;
    for (const double place : x) good = good && kernels::is_finite(place);
    if (done_) return {};
    if (!good) return lost();
    numbers force{};
    for (std::size_t i = 0; i < x.size(); ++i) {
      force[i] = axes_[i].tick(x[i], dt, p_.moves, p_.way, p_.force, !waits_);
      const char* why = axes_[i].problem(p_.way);
      if (!waits_ && why != nullptr) return fail(why);
      weighed = weighed && axes_[i].found().cycles >= cycles;
    }
    if (weighed) conclude();
    return done_ || (waits_ && stage_ == 0) ? numbers{} : force;
  }
  /// Call it in place of tick() if nothing was read. The forces are 0.
  numbers lost() noexcept {
    for (auto& axis : axes_) axis.lost();
    const char* why = axes_[0].problem(p_.way);
    return why != nullptr ? fail(why) : numbers{};
  }
  void stop() noexcept { fail("it was stopped before the end"); }

  /// The sentence that says what is to be done before confirm(); null while it weighs, and at the end.
  [[nodiscard]] const char* asks() const noexcept {
    if (done_ || !waits_) return nullptr;
    return stage_ == 1   ? "hang the mass on the handle, and let go"
           : stage_ == 2 ? "take the mass off, and let go"
           : pose_ == 0  ? "hold the device at its first pose, with nothing hung on it, and let go "
                           "when it pulls"
                         : "hold the device at its next pose, with nothing hung on it, and let go "
                           "when it pulls";
  }
  /// What it asks for is done.
  void confirm() noexcept {
    if (!waits_) return;
    waits_ = false;
    for (auto& axis : axes_) axis.begin(stage_ == 0);
  }
  [[nodiscard]] bool done() const noexcept { return done_; }
  [[nodiscard]] gains_found<Dof> result() const noexcept {
    auto found = found_;
    if (!done_) found.problem = "it is not at its end";
    return found;
  }

 private:
  static constexpr int cycles = 8;
  static constexpr double confidence = 4.5;
  static constexpr const char* too_light =
      "the mass is too light for the friction: hang the least mass stated, or more";

  /// What the mass changed at a pose, in newtons of the motors, the bound of its error, and the weight.
  struct change {
    numbers d{}, error{}, w{};
  };

  numbers fail(const char* why) noexcept {
    if (!done_) found_.problem = why;
    done_ = true;
    return {};
  }
  [[nodiscard]] static double dot(const numbers& a, const numbers& b) noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  }
  /// A force of the port as the motors have it, or the bound of an error.
  [[nodiscard]] static numbers of_motors(const weighed_pose<Dof>& pose, const numbers& f,
                                         bool bound = false) noexcept {
    numbers all = f;
    for (std::size_t i = 0; i < f.size(); ++i) {
      numbers row = pose.rows[i];
      if (!(dot(row, row) > 0.0)) continue;
      for (double& x : row) x = bound ? kernels::magnitude(x) : x;
      all[i] = dot(row, f);
    }
    return all;
  }
  /// The bound of the error [N] of a load that is compared with the mean of two others.
  [[nodiscard]] double error_of(const weighed_load& l) const noexcept {
    return confidence * l.deviation() * std::sqrt(1.5 / cycles) + 0.01 * l.friction;
  }

  void conclude() noexcept {
    numbers w = poses_[pose_].pulls;
    for (double& x : w) x *= p_.mass * 9.80665;
    const double size = std::sqrt(dot(w, w));
    for (std::size_t i = 0; i < w.size(); ++i) {
      const weighed_load& l = axes_[i].found();
      stages_[static_cast<std::size_t>(stage_)][i] = l;
      found_.spread = (std::max)(found_.spread, l.deviation());
      found_.friction = (std::max)(found_.friction, l.friction);
      const double held = (std::max)(l.stiffness, 2.0 * (l.stiffness - stages_[0][i].stiffness));
      if (held * p_.way > 0.025 * size) {  // the inertia of the turns is < 0
        fail("something holds it like a spring: let go of the device, and keep off its stops");
      }
      if (l.deviation() > 0.1 * size) {
        fail(
            "the force varies from cycle to cycle: let go of it, or hang more, that does not "
            "swing");
      }
    }
    numbers hung{}, changed{}, error{};
    for (std::size_t i = 0; i < w.size(); ++i) {
      const auto& [empty, loaded, again] = stages_;
      changed[i] = stage_ == 2 ? again[i].load - empty[i].load : 0.0;
      hung[i] = empty[i].load + 0.5 * changed[i] - loaded[i].load;
      for (const auto& s : stages_) error[i] = (std::max)(error[i], error_of(s[i]));
      error[i] += 0.5 * kernels::magnitude(changed[i]);
    }
    if (stage_ == 0) {
      needs(std::sqrt(dot(error, error)) / size);
    } else if (stage_ == 1) {
      const double share = dot(hung, w) / (size * size);
      if (share < 0.3) fail("the mass was not hung, or does not pull where stated");
      if (share > 3.0) fail("the mass pulls three times as much as stated: is a hand on it?");
    } else {
      if (std::sqrt(dot(changed, changed)) > 2.0 * p_.precision * size) {
        fail("it is not as it was: take the mass off, let it warm up, and fasten it");
      }
      const auto& pose = poses_[pose_];
      known_[pose_] = {of_motors(pose, hung), of_motors(pose, error, true), of_motors(pose, w)};
    }
    waits_ = true;
    stage_ = (stage_ + 1) % 3;
    if (!done_ && stage_ == 0 && ++pose_ == poses_.size()) solve();
  }
  /// Refuses a mass whose weight is known to that share only.
  void needs(double share) noexcept {
    found_.least_mass = (std::max)(found_.least_mass, share / p_.precision * p_.mass);
    if (!(share <= p_.precision)) fail(too_light);
  }
  void solve() noexcept {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      double ww = 0.0, wd = 0.0, we = 0.0;
      for (const change& of : known_) {
        const double w = of.w[i];
        if (w * w > 0.04 * dot(of.w, of.w)) {
          ww += w * w;
          wd += w * of.d[i];
          we += kernels::magnitude(w) * of.error[i];
        }
      }
      if (!(wd > 0.0)) {
        fail("a pose is missing, or wrong: the mass pulls on an axis in none of them");
        return;
      }
      const double r = wd / ww, e = we / ww;
      needs(e / r);
      found_.likely[i] = 1.0 / r;
      found_.least[i] = (1.0 - p_.mass_tolerance) / (r + e);
      found_.most[i] = (1.0 + p_.mass_tolerance) / (r - e);
      for (const change& of : known_) {
        const double off = kernels::magnitude(of.d[i] - r * of.w[i]);
        if (off > of.error[i] + p_.precision * std::sqrt(dot(of.w, of.w))) {
          fail("the poses disagree: state where the mass pulls in each");
        }
      }
    }
    done_ = true;
  }

  weigh_in_parameters p_;
  std::vector<weighed_pose<Dof>> poses_;
  std::vector<change> known_;
  std::array<weighed_axis, static_cast<std::size_t>(Dof)> axes_{};
  std::array<std::array<weighed_load, static_cast<std::size_t>(Dof)>, 3> stages_{};
  gains_found<Dof> found_{};
  std::size_t pose_ = 0;
  int stage_ = 0;  // 0: nothing is hung, 1: the mass is, 2: nothing again
  bool waits_ = true, done_ = false;
};

/// Weighs with `device`, in a loop of its own. The last command is a force of zero.
template <port P, haptic_device_for<P> Device, class Ready, class Stop>
[[nodiscard]] gains_found<P::dof> weigh(Device& device, weigh_in<P::dof> scale, Ready&& ready,
                                        Stop&& stop) {
  const detail::no_force_at_the_end<P, Device> end(device);
  typename P::effort force = P::zero();
  while (!scale.done()) {
    const auto sample = device.exchange(force);
    const typename P::pose place = sample.position;
    if (stop()) scale.stop();
    if (scale.asks() != nullptr && ready(scale.asks())) scale.confirm();
    axis_numbers<P::dof> x{};
    for (int i = 0; i < P::dof; ++i) {
      x[static_cast<std::size_t>(i)] = static_cast<double>(P::component(place, i));
    }
    const auto f =
        sample.valid ? scale.tick(x, seconds{static_cast<double>(sample.dt)}) : scale.lost();
    for (int i = 0; i < P::dof; ++i) {
      P::component(force, i) = static_cast<typename P::scalar>(f[static_cast<std::size_t>(i)]);
    }
  }
  return scale.result();
}

}  // namespace identification
}  // namespace v0
}  // namespace passive_haptics
