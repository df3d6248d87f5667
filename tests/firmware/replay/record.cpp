// SPDX-License-Identifier: BSD-3-Clause
// Writes the recording that host and target play back: record FILE. For each scene a device of
// 0.1 kg, moved by a hand, touches a surface that heaves and tilts (0.17 s at 5 kHz, ticks that
// vary by 10 %); then comes all that can go wrong, but not to the scene that trusts its samples.
// Additions, products and quotients only, built without contraction: every machine writes the same
// bits.
#include "subjects.hpp"

#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace {

using replay::bits;
using replay::sample;
using replay::surface;

static_assert(std::is_same_v<real, float>, "the recording is made in float");

constexpr int good_ticks = 850, rough_ticks = 350;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Numbers in [0, 1) that are the same everywhere.
class dice {
 public:
  float roll() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    state_ ^= state_ << 5;
    return static_cast<float>(state_ >> 8) * 0x1p-24F;
  }
  float between(float low, float high) { return low + (high - low) * roll(); }
  int below(int n) { return static_cast<int>(roll() * static_cast<float>(n)); }

 private:
  std::uint32_t state_ = 2463534242U;
};

/// From −1 to 1 and back in one period.
float wave(float t, float period) {
  const float turns = t / period;
  const float part = turns - static_cast<float>(static_cast<int>(turns));
  return part < 0.5F ? 4.0F * part - 1.0F : 3.0F - 4.0F * part;
}

struct place {
  float x[3] = {};
};

/// What the environment publishes at time t. Axis dof − 1 points out of the object.
surface world(float t, int dof, bool triangle) {
  const float heave = 0.002F * wave(t, 0.07F);
  const float tilt = 0.25F * wave(t, 0.11F), other = 0.2F * wave(t, 0.19F);
  const auto b = [](float v) { return std::bit_cast<bits>(v); };
  const float stiffness = 3000.0F + 1500.0F * wave(t, 0.13F);
  surface s{};
  s.stiffness = b(stiffness);
  if (triangle) {
    const float r = 0.02F;
    const float za = heave - r * tilt, zb = heave + r * tilt, zc = heave + r * other;
    return {{b(-r), b(-r), b(za)}, {b(r), b(-r), b(zb)}, {b(0), b(r), b(zc)}, b(stiffness)};
  }
  if (dof == 1) {
    s.a[0] = b(heave);
    s.b[0] = b(2.0F);
  } else if (dof == 2) {
    s.a[1] = b(heave);
    s.b[0] = b(tilt);
    s.b[1] = b(1.0F);
  } else {
    s.a[2] = b(heave);
    s.b[0] = b(tilt);
    s.b[1] = b(other);
    s.b[2] = b(1.0F);
  }
  return s;
}

/// A surface that nobody can use.
surface broken(surface s, int kind) {
  switch (kind) {
    case 0:
      s.stiffness = std::bit_cast<bits>(0.0F);
      break;
    case 1:
      s.a[0] = std::bit_cast<bits>(nan);
      break;
    case 2:
      for (int i = 0; i < 3; ++i) s.b[i] = s.a[i] = s.c[i] = 0;
      break;
    default:
      s.stiffness = std::bit_cast<bits>(infinity);
  }
  return s;
}

template <class Subject>
class session {
 public:
  static constexpr int dof = Subject::dof;
  static constexpr bool triangle = std::is_same_v<Subject, replay::composed_triangle_thesis>;
  static constexpr bool trusting = std::is_same_v<Subject, replay::composed_wall_trusted>;

  session() {
    const int rough_from = trusting ? good_ticks + rough_ticks : good_ticks;
    for (int n = 0; n < good_ticks + rough_ticks; ++n) {
      n < rough_from ? good(n) : rough(n - rough_from);
    }
  }

  void write(std::FILE* file) const {
    const std::string name = Subject::scene;
    std::fprintf(file, "inline constexpr sample %s_samples[] = {\n", name.c_str());
    for (const sample& s : samples_) {
      std::fprintf(file, "    {{0x%08xU, 0x%08xU, 0x%08xU}, 0x%08xU, %d},\n", s.x[0], s.x[1],
                   s.x[2], s.dt, s.news);
    }
    std::fprintf(file, "};\ninline constexpr surface %s_surfaces[] = {\n", name.c_str());
    for (const surface& s : surfaces_) {
      std::fprintf(file,
                   "    {{0x%08xU, 0x%08xU, 0x%08xU}, {0x%08xU, 0x%08xU, 0x%08xU}, "
                   "{0x%08xU, 0x%08xU, 0x%08xU}, 0x%08xU},\n",
                   s.a[0], s.a[1], s.a[2], s.b[0], s.b[1], s.b[2], s.c[0], s.c[1], s.c[2],
                   s.stiffness);
    }
    std::fprintf(file, "};\ninline constexpr recording %s{\"%s\", %s_samples, %zu, %s_surfaces};\n",
                 name.c_str(), name.c_str(), name.c_str(), samples_.size(), name.c_str());
  }

 private:
  void good(int n) {
    const float dt = 0.0002F * dice_.between(0.9F, 1.1F);
    time_ += dt;
    const int news = n % 25 == 3 ? publish(world(time_, dof, triangle)) : -1;
    const place force = step(dt, news, where_);
    for (int i = 0; i < dof; ++i) {
      // Press with the last axis, slide with the others, off the triangle's edges and back.
      const float goal = i == dof - 1 ? 0.001F + 0.009F * wave(time_ + 0.03F, 0.06F)
                                      : 0.025F * wave(time_, 0.08F + 0.01F * static_cast<float>(i));
      const float hand = 400.0F * (goal - where_.x[i]) - 2.0F * speed_[i];
      speed_[i] += (hand + force.x[i] - 0.5F * speed_[i]) * dt / 0.1F;
      where_.x[i] += speed_[i] * dt;
    }
  }

  void rough(int n) {
    float dt = 0.0002F * dice_.between(0.5F, 1.5F);  // some are late
    int news = -1;
    const bool silent = n >= 150 && n < 300;  // longer than stale_after and fade
    if (!silent && dice_.below(8) == 0) {
      const surface s = world(time_ + dice_.between(0.0F, 0.2F), dof, triangle);
      news = publish(dice_.below(3) == 0 ? broken(s, dice_.below(4)) : s);
    }
    time_ += dt;
    for (int i = 0; i < dof; ++i)
      where_.x[i] += dice_.between(-0.002F, 0.002F) - 0.02F * where_.x[i];
    place shown = where_;
    switch (dice_.below(25)) {
      case 0:
        shown.x[dice_.below(dof)] = nan;
        break;
      case 1:
        shown.x[dice_.below(dof)] = -infinity;
        break;
      case 2:
        shown.x[dice_.below(dof)] = 1000.0F;
        break;
      case 3:
        dt = 0.0F;
        break;
      case 4:
        dt = -dt;
        break;
      case 5:
        dt = nan;
        break;
      case 6:
        dt = infinity;
        break;
      case 7:
        dt *= 20.0F;
        break;
      default:
        break;
    }
    (void)step(dt, news, shown);
  }

  int publish(const surface& s) {
    surfaces_.push_back(s);
    return static_cast<int>(surfaces_.size()) - 1;
  }

  place step(float dt, int news, place at) {
    sample s{{}, std::bit_cast<bits>(dt), news};
    for (int i = 0; i < 3; ++i) s.x[i] = std::bit_cast<bits>(at.x[i]);
    samples_.push_back(s);
    if (news >= 0) subject_.update(surfaces_[static_cast<std::size_t>(news)]);
    using position = typename Subject::position;
    const auto out = Subject::call(subject_.model, replay::vector_of<position, dof>(s.x), dt);
    place result;
    for (int i = 0; i < dof; ++i) result.x[i] = Subject::space::component(out.force, i);
    return result;
  }

  Subject subject_;
  dice dice_;
  place where_;
  float speed_[3] = {};
  float time_ = 0;
  std::vector<sample> samples_;
  std::vector<surface> surfaces_{surface{}};  // never empty
};

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: record FILE\n", stderr);
    return 2;
  }
  std::FILE* file = std::fopen(arguments[1], "w");
  if (file == nullptr) {
    std::fprintf(stderr, "record: %s cannot be written\n", arguments[1]);
    return 1;
  }
  std::fputs(
      "// Written by record.cpp.\n#pragma once\n#include \"recording.hpp\"\n\n"
      "namespace replay::recorded {\n",
      file);
  session<replay::composed_wall_trusted>().write(file);
  session<replay::composed_wall_strict>().write(file);
  session<replay::composed_wall_reachable>().write(file);
  session<replay::composed_plane_strict>().write(file);
  session<replay::composed_plane_reachable>().write(file);
  session<replay::composed_triangle_thesis>().write(file);
  std::fputs("}  // namespace replay::recorded\n", file);
  return std::fclose(file) == 0 ? 0 : 1;
}
