// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A device of one axis with what may be wrong with it: a hand, a mode, backlash, a force that is a fraction of a tick
// late or filtered, cogging, drift. All of them act at once if they are drawn at once. It is integrated in 50 steps a
// tick, semi-implicitly.
//
//   force ─▶ late, filtered ─▶ rotor m_r, b, friction, load, cogging ──(k_c, d_c, gap)── handle m_h ◀── hand
//                               └─▶ encoder

#include "subject.hpp"
#include <passive_haptics/identification/disturbance.hpp>

#include <string>

namespace identify {

using identification::disturbance;

/// What is wrong with a device; 0 is nothing.
struct wrongs {
  double share = 1.0;         ///< mass of the rotor over all of it; 1: one rigid mass
  double mode = 0.0;          ///< free resonance, 15 to 400 [Hz]
  double loss = 0.03;         ///< ζ of it
  double gap = 0.0;           ///< backlash, 30 to 500 µm from end to end [m]
  double fraction = 0.0;      ///< of a tick that the force is late besides the whole ones
  double lag = 0.0;           ///< time constant of a first-order filter [s]
  double cogging = 0.0;       ///< amplitude [N]
  double wavelength = 1e-3;   ///< of the cogging [m]
  double warms = 0.0;         ///< share by which friction falls while it is measured
  double load_drifts = 0.0;   ///< [N/s]
  double grip = 0.0;          ///< stiffness of a hand [N/m]
  double grip_damping = 0.0;  ///< [N·s/m]
  double grip_mass = 0.0;     ///< [kg]
  double follows = 0.0;       ///< time constant with which the hand follows [s]; 0: it holds still
};

struct disturbed {
  subject rigid{};
  wrongs has{};

  [[nodiscard]] bool is(disturbance what) const noexcept;
  /// Does what the sentence that refuses a device for `what` asks for.
  void remedy(disturbance what) noexcept;
  /// What moves rigidly with the encoder [kg].
  [[nodiscard]] double rotor() const noexcept { return has.share * rigid.mass; }
};

/// Each wrong by itself with a chance of `chance`; backlash and a mode exclude each other.
[[nodiscard]] disturbed draw_disturbed(std::uint64_t seed, double chance = 0.12);

class disturbed_device {
 public:
  explicit disturbed_device(const disturbed& truth) noexcept;
  /// Holds the force [N] for a tick and returns the position that the encoder shows at its end [m].
  double exchange(double force) noexcept;

 private:
  void step(double force) noexcept;

  static constexpr int steps = 50;
  static constexpr double period = 1e-3, h = period / steps;
  subject s_;
  wrongs w_;
  double spring_ = 0.0, damper_ = 0.0;
  std::array<double, 8> commands_{};
  std::array<double, 3> slider_{};
  double x_, v_ = 0.0, handle_, handle_v_ = 0.0, held_at_, filtered_ = 0.0, time_ = 0.0;
};

/// What was found of it.
struct disturbed_verdict {
  disturbed truth{};
  identification::axis_found found{};
  double seconds = 0.0;  ///< that the device was busy

  [[nodiscard]] bool refused() const { return found.problem != nullptr; }
  /// Found by its name. A fraction and a filter are one: the low-pass of a lag below half a tick is a fraction within what
  /// the steps show, and either is refused.
  [[nodiscard]] bool names(disturbance what) const {
    const auto is = [this](disturbance d) {
      return found.wrong.of(d).found ||
             (refused() && refusal_of(d) != nullptr && std::string(found.problem) == refusal_of(d));
    };
    if (what == disturbance::fraction || what == disturbance::filter) {
      return is(disturbance::fraction) || is(disturbance::filter);
    }
    if (what == disturbance::hand && refused() && !found.wrong.refusal() && !of_two_names()) {
      return std::string(found.problem).find("let go") != std::string::npos;
    }
    return is(what);
  }
  /// Refused by the sentence that names a hand and the transmission, because no motion tells them apart.
  [[nodiscard]] bool of_two_names() const {
    return refused() && std::string(found.problem) == identification::held_or_gives;
  }
  /// That sentence names it, and nothing else does.
  [[nodiscard]] bool names_as_one_of_two(disturbance what) const {
    return of_two_names() && !names(what) &&
           (what == disturbance::hand || what == disturbance::mode);
  }
  [[nodiscard]] bool has(disturbance what) const {
    const bool late = what == disturbance::fraction || what == disturbance::filter;
    return late ? truth.is(disturbance::fraction) || truth.is(disturbance::filter) : truth.is(what);
  }
  /// True where it is refused, or no lower bound is above the truth. Of a device that drifts what is stated counts, less
  /// the drift that is allowed for.
  [[nodiscard]] bool mass() const { return refused() || found.moves_rigidly() <= truth.rotor(); }
  [[nodiscard]] bool damping() const { return refused() || found.damping <= truth.rigid.damping; }
  [[nodiscard]] bool friction() const {
    const double kept = truth.has.warms > 0.0 ? identification::trust{}.kept() : 1.0;
    return refused() || found.friction * kept <= truth.rigid.friction * (1.0 - truth.has.warms);
  }
};
[[nodiscard]] disturbed_verdict identified(const disturbed& truth);

/// The first session of a device, and what comes of those that follow: while it is refused for something that is wrong
/// with it, that is mended, and it is identified again. What is named in none of them is never found. Where two names are
/// given, the hand goes first, and then the transmission is stiffened.
struct mended_verdict : disturbed_verdict {
  std::array<bool, identification::disturbances> found_in_any{}, one_of_two_in_any{};
  int sessions = 0;
  double longest = 0.0;       ///< session [s]
  bool ends_refused = false;  ///< for nothing that is wrong with it
  int stated = 0;             ///< sessions that ended with bounds
  int mass_above = 0, damping_above = 0,
      friction_above = 0;  ///< of these, with a bound above the truth
};
[[nodiscard]] mended_verdict identified_until_mended(const disturbed& truth);

}  // namespace identify
