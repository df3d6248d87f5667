// SPDX-License-Identifier: BSD-3-Clause
// What one exchange with a Falcon costs the host, the cable left out: parts and whole, p50 and
// p99.9 over blocks of 20, on replies recorded from a moving mock.
#include "../common/failures.hpp"
#include "../common/options.hpp"
#include "../common/text.hpp"
#include <passive_haptics/falcon/device.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <string>
#include <vector>

namespace {

namespace ph = passive_haptics;
namespace falcon = passive_haptics::falcon;
using experiments::format;
using room = ph::space<double, 3>;

/// Answers every packet at once with the next reply of a recording.
class recorded_line {
 public:
  explicit recorded_line(const std::vector<falcon::packet_bytes>& replies) : replies_(&replies) {}

  falcon::result open() noexcept {
    open_ = true;
    return {};
  }
  void close() noexcept { open_ = false; }
  [[nodiscard]] bool is_open() const noexcept { return open_; }
  falcon::result control(falcon::request /*r*/, std::uint16_t /*value*/) noexcept { return {}; }
  falcon::result write(std::span<const falcon::byte> /*out*/,
                       falcon::nanoseconds /*deadline*/) noexcept {
    waiting_ = true;
    return {};
  }
  falcon::transfer read(std::span<falcon::byte> in, falcon::nanoseconds /*deadline*/) noexcept {
    now_ += std::chrono::microseconds(500);
    if (!waiting_) return {{falcon::code::timeout}, 0, now_};
    waiting_ = false;
    const auto& reply = (*replies_)[next_];
    next_ = next_ + 1 == replies_->size() ? 0 : next_ + 1;
    std::copy(reply.begin(), reply.end(), in.begin());
    return {{}, reply.size(), now_};
  }
  [[nodiscard]] falcon::ftdi::line_status lines() const noexcept { return {}; }
  [[nodiscard]] falcon::nanoseconds now() const noexcept { return now_; }

 private:
  const std::vector<falcon::packet_bytes>* replies_;
  std::size_t next_ = 0;
  falcon::nanoseconds now_{0};
  bool open_ = false, waiting_ = false;
};

/// A hand that goes round at about 0.3 m/s, forth and back so that the recording can be repeated.
std::vector<falcon::packet_bytes> recording() {
  std::vector<falcon::packet_bytes> replies;
  for (int n = 0; n < 2000; ++n) {
    const double turn = 2.0 * falcon::pi<double> * (n < 1000 ? n : 2000 - n) / 1000.0;
    const falcon::point<double> p{
        {0.03 * std::cos(turn), 0.03 * std::sin(turn), 0.125 + 0.015 * std::sin(2.0 * turn)}};
    const auto counts = falcon::to_counts(falcon::inverse(p).value);
    falcon::from_device reply{.homed = falcon::from_device::all_legs};
    for (std::size_t i = 0; i < 3; ++i) reply.encoder[i] = static_cast<std::int16_t>(counts[i]);
    replies.push_back(falcon::encode(reply));
  }
  return replies;
}

struct timing {
  double p50, p999;  ///< [ns] per call
};

/// The times of `blocks` blocks of 20 calls.
template <class Call>
timing measure(int blocks, Call call) {
  using clock = std::chrono::steady_clock;
  constexpr int calls = 20;
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(blocks));
  for (int i = 0; i < blocks; ++i) {
    const auto start = clock::now();
    for (int j = 0; j < calls; ++j) call();
    times.push_back(std::chrono::duration<double, std::nano>(clock::now() - start).count() / calls);
  }
  std::sort(times.begin(), times.end());
  const auto at = [&times](double part) {
    return times[static_cast<std::size_t>(part * static_cast<double>(times.size() - 1))];
  };
  return {at(0.5), at(0.999)};
}

/// Kept from the optimiser.
template <class T>
void use(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

/// Parse, forward, torques, encode: the exchange without states and safety.
template <class S>
struct by_hand {
  const std::vector<falcon::packet_bytes>& replies;
  std::size_t next = 0;
  falcon::packet_parser<falcon::from_device> parser{};
  falcon::from_device reply{};
  falcon::pose_result<S> pose{};
  falcon::torques<S> torque{};
  falcon::dac_words words{};

  void parse() {
    next = next + 1 == replies.size() ? 0 : next + 1;
    for (const auto b : replies[next]) {
      if (const auto packet = parser.push(b)) reply = *packet;
    }
  }
  void locate() {
    const auto& n = reply.encoder;
    pose = falcon::forward(falcon::to_angles<S>({n[0], n[1], n[2]}), pose.position);
  }
  void command() {
    torque = falcon::torques_for(pose.rates, falcon::force<S>{{S(1), S(2), S(-3)}});
    words = falcon::encode(torque, falcon::cautious_gain<S>);
  }
  void send() { use(falcon::encode(falcon::to_device{.motor = words})); }
};

template <class S>
void add_parts(experiments::table& table, const std::string& scalar, int blocks,
               const std::vector<falcon::packet_bytes>& replies) {
  by_hand<S> loop{replies};
  loop.pose.position = falcon::workspace<S>.centre;
  loop.parse();
  loop.locate();
  const auto row = [&](const std::string& what, const timing& t) {
    table.add({what, scalar, format("%.0f", t.p50), format("%.0f", t.p999)});
  };
  row("parse 16 bytes", measure(blocks, [&] {
        loop.parse();
        use(loop.reply);
      }));
  row("parse, and forward from the last position", measure(blocks, [&] {
        loop.parse();
        loop.locate();
        use(loop.pose);
      }));
  row("torques and words of a force", measure(blocks, [&] {
        loop.command();
        use(loop.words);
      }));
  row("parse, forward, torques, words, packet", measure(blocks, [&] {
        loop.parse();
        loop.locate();
        loop.command();
        loop.send();
      }));
}

int run(const std::vector<std::string>& arguments) {
  int blocks = 20000;
  experiments::read_options(
      "falcon_cost",
      {experiments::a_number("--blocks",
                             "of 20 calls, to be timed (default: " + std::to_string(blocks) + ")",
                             blocks)},
      arguments);
  const auto replies = recording();
  experiments::table table({"what", "scalar", "p50 / ns", "p99.9 / ns"});
  add_parts<double>(table, "double", blocks, replies);
  add_parts<float>(table, "float", blocks, replies);

  falcon::device<recorded_line, room> device{falcon::cautious_gain<double>, {}, replies};
  (void)device.open();
  (void)device.start([](auto&) { return falcon::result{}; });
  if (!device.home(std::chrono::seconds(10))) {
    return experiments::ended("falcon_cost", {std::string("the recording does not home: ") +
                                              to_string(device.latest().what)});
  }
  const room::vector force(1.0, 2.0, -3.0);
  long lost = 0;
  for (int n = 0; n < 2000; ++n) (void)device.exchange(force);
  const timing whole = measure(blocks, [&] { lost += device.exchange(force).valid ? 0 : 1; });
  table.add({"device::exchange, cable left out", "double", format("%.0f", whole.p50),
             format("%.0f", whole.p999)});
  table.print(std::cout);
  experiments::failures found;
  experiments::expect(found, lost == 0, std::to_string(lost) + " samples were not valid");
  experiments::expect(found, whole.p50 <= 2000.0,
                      format("an exchange takes %.0f ns, more than 2000", whole.p50));
  return experiments::ended("falcon_cost", found);
}

}  // namespace

int main(int argc, char** argv) {
  return experiments::guarded("falcon_cost", [&] { return run({argv + 1, argv + argc}); });
}
