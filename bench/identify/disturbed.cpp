// SPDX-License-Identifier: BSD-3-Clause
#include "disturbed.hpp"

#include <passive_haptics/simulation/schedule.hpp>

#include <numbers>

namespace identify {

bool disturbed::is(disturbance what) const noexcept {
  switch (what) {
    case disturbance::hand:
      return has.grip > 0.0;
    case disturbance::mode:
      return has.mode > 0.0;
    case disturbance::backlash:
      return has.gap > 0.0;
    case disturbance::fraction:
      return has.fraction > 0.0;
    case disturbance::filter:
      return has.lag > 0.0;
    case disturbance::cogging:
      return has.cogging > 0.0;
    case disturbance::drift:
      return has.warms > 0.0 || has.load_drifts != 0.0;
  }
  return false;
}

void disturbed::remedy(disturbance what) noexcept {
  switch (what) {
    case disturbance::hand:
      has.grip = has.grip_damping = has.grip_mass = 0.0;
      break;
    case disturbance::mode:
      has.share = 1.0;
      has.mode = 0.0;
      break;
    case disturbance::backlash:
      has.share = 1.0;
      has.gap = 0.0;
      break;
    case disturbance::fraction:
      has.fraction = 0.0;
      break;
    case disturbance::filter:
      has.lag = 0.0;
      break;
    case disturbance::cogging:
      has.cogging = 0.0;
      break;
    case disturbance::drift:
      has.warms = has.load_drifts = 0.0;
      break;
  }
}

disturbed draw_disturbed(std::uint64_t seed, double chance) {
  disturbed d{.rigid = draw(seed)};
  subject& s = d.rigid;
  s.load *= 0.5;
  if (s.like == rubbing::dupont) s.like = rubbing::one_spring;
  if (s.presliding > 0.0) s.presliding = std::max(s.presliding, 2e-6);
  sim::random_source random(seed ^ 0x9e3779b97f4a7c15ULL);
  const auto evenly_by_logarithm = [&](double least, double most) {
    return least * std::pow(most / least, random.uniform());
  };
  wrongs& w = d.has;
  const double share = random.uniform(0.1, 0.9), hz = evenly_by_logarithm(15.0, 400.0);
  w.loss = random.uniform(0.01, 0.1);
  const double gap = evenly_by_logarithm(30e-6, 500e-6);
  const double fraction = random.uniform(0.1, 0.9), lag = evenly_by_logarithm(0.3e-3, 3e-3);
  const double cogging = random.uniform(0.05, 0.3), length = evenly_by_logarithm(0.3e-3, 5e-3);
  const double warms = random.uniform(0.2, 0.5), load = random.uniform(0.1, 0.5) / 60.0;
  const double grip = evenly_by_logarithm(10.0, 800.0), damping = random.uniform(0.5, 5.0);
  const double mass = random.uniform(0.02, 0.2), follows = evenly_by_logarithm(0.05, 1.0);
  if (random.chance(chance)) {
    w.share = share;
    w.mode = hz;
  } else if (random.chance(chance)) {
    w.share = share;
    w.gap = gap;
  }
  if (random.chance(chance)) w.fraction = fraction;
  if (random.chance(chance)) w.lag = lag;
  if (random.chance(chance)) w.cogging = cogging;
  w.wavelength = length;
  if (random.chance(chance)) {
    if (random.chance(0.5) && s.friction > 0.05) {
      w.warms = warms;
    } else {
      w.load_drifts = random.chance(0.5) ? load : -load;
    }
  }
  if (random.chance(chance)) {
    w.grip = grip;
    w.grip_damping = damping;
    w.grip_mass = mass;
    if (random.chance(0.3)) w.follows = follows;
  }
  return d;
}

disturbed_device::disturbed_device(const disturbed& truth) noexcept
    : s_(truth.rigid), w_(truth.has), x_(s_.start), handle_(s_.start), held_at_(s_.start) {
  if (w_.share >= 1.0) return;
  const double reduced = w_.share * (1.0 - w_.share) * s_.mass;
  const double omega = w_.gap > 0.0 ? 0.1 / h : 2.0 * std::numbers::pi * w_.mode;
  spring_ = reduced * omega * omega;
  damper_ = 2.0 * (w_.gap > 0.0 ? 0.2 : w_.loss) * omega * reduced;
}

double disturbed_device::exchange(double force) noexcept {
  for (std::size_t i = commands_.size() - 1; i > 0; --i) commands_[i] = commands_[i - 1];
  commands_[0] = force;
  const auto late = static_cast<std::size_t>(s_.latency);
  for (int i = 0; i < steps; ++i) {
    const bool before = i < w_.fraction * steps;
    step(commands_[before ? late + 1 : late]);
  }
  const double seen = x_ - v_ * h / 2.0;  // the steps run ahead by half of one
  return s_.quantum * std::round(seen / s_.quantum);
}

void disturbed_device::step(double force) noexcept {
  filtered_ = w_.lag > 0.0 ? filtered_ + (force - filtered_) * h / (w_.lag + h) : force;
  // Friction: one slider, or three, whose level falls with time, with speed, and varies along the way.
  const double warmth = 1.0 - w_.warms * std::min(time_ / 45.0, 1.0);
  const double ripple =
      s_.ripple > 0.0 ? (1.0 + s_.ripple * std::sin(2.0 * std::numbers::pi * x_ / s_.wavelength)) /
                            (1.0 - s_.ripple)
                      : 1.0;
  const bool stribeck = s_.like == rubbing::stribeck || s_.like == rubbing::rippled;
  const double slow = v_ / s_.stribeck_speed;
  const double level = s_.friction * warmth * ripple *
                       (stribeck ? 1.0 + (s_.static_share - 1.0) * std::exp(-slow * slow) : 1.0);
  double rubs = 0.0;
  const std::size_t sliders = s_.like == rubbing::three_springs ? 3 : 1;
  for (std::size_t i = 0; i < sliders; ++i) {
    const double p =
        std::max(s_.presliding, 1e-6) * (sliders == 3 ? 0.5 * static_cast<double>(i + 1) : 1.0);
    slider_[i] = std::clamp(slider_[i] + v_ * h, -p, p);
    rubs += level / static_cast<double>(sliders) * slider_[i] / p;
  }
  double link = 0.0;
  if (w_.share < 1.0) {
    const double apart = x_ - handle_;
    const double over = std::max(std::abs(apart) - w_.gap / 2.0, 0.0);
    if (over > 0.0 || !(w_.gap > 0.0)) {
      link = spring_ * std::copysign(over, apart) + damper_ * (v_ - handle_v_);
      if (w_.gap > 0.0 && link * apart < 0.0) link = 0.0;  // it cannot pull
    }
  }
  const double cog = w_.cogging * std::sin(2.0 * std::numbers::pi * x_ / w_.wavelength);
  const double load = s_.load + w_.load_drifts * time_;
  const bool rigid = w_.share >= 1.0;
  const double at = rigid ? x_ : handle_, speed = rigid ? v_ : handle_v_;
  double hand = 0.0;
  if (w_.grip > 0.0) {
    hand = -w_.grip * (at - held_at_) - w_.grip_damping * speed;
    if (w_.follows > 0.0) held_at_ += (at - held_at_) * h / w_.follows;
  }
  const double on_rotor =
      filtered_ + load + cog - s_.damping * v_ - rubs - link + (rigid ? hand : 0.0);
  v_ += h * on_rotor / (w_.share * s_.mass + (rigid ? w_.grip_mass : 0.0));
  x_ += h * v_;
  if (!rigid) {
    handle_v_ += h * (link + hand) / ((1.0 - w_.share) * s_.mass + w_.grip_mass);
    handle_ += h * handle_v_;
  }
  time_ += h;
}

disturbed_verdict identified(const disturbed& truth) {
  disturbed_device device(truth);
  identification::axis_identification of;
  double force = 0.0;
  while (!of.done()) force = of.tick(device.exchange(force), ph::seconds{1e-3});
  return {truth, of.result(), of.time()};
}

mended_verdict identified_until_mended(const disturbed& truth) {
  mended_verdict all{identified(truth)};
  disturbed_verdict now = all;
  while (true) {
    ++all.sessions;
    all.longest = std::max(all.longest, now.seconds);
    if (!now.refused()) {
      ++all.stated;
      all.mass_above += now.mass() ? 0 : 1;
      all.damping_above += now.damping() ? 0 : 1;
      all.friction_above += now.friction() ? 0 : 1;
    }
    disturbed next = now.truth;
    bool mended = false;
    for (std::size_t i = 0; i < identification::disturbances; ++i) {
      const auto kind = static_cast<disturbance>(i);
      if (!now.truth.is(kind)) continue;
      const bool named = now.names(kind);
      const bool of_two = !mended && now.names_as_one_of_two(kind);
      all.found_in_any[i] = all.found_in_any[i] || named;
      all.one_of_two_in_any[i] = all.one_of_two_in_any[i] || of_two;
      if (!now.refused() || !(named || of_two)) continue;
      next.remedy(kind);
      mended = true;
    }
    if (!mended) break;
    now = identified(next);
  }
  all.ends_refused = now.refused();
  return all;
}

}  // namespace identify
