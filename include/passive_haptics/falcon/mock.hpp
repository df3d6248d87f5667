// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simulated Falcon: the far side of in_memory_transport.
//
//   host ─▶ bytes ─▶ mock_processor ─▶ motor words ─▶ mock_mechanism ◀─ hand
//   host ◀─ bytes ◀─ FTDI bridge    ◀─ counts     ◀─┘
//
// The whole driver runs on it unchanged, in virtual time. It simulates the Falcon that the headers of falcon/ describe.
// So a test on it shows that the driver agrees with them, and not that they describe a real Falcon.

#include <passive_haptics/falcon/mock_mechanism.hpp>
#include <passive_haptics/falcon/mock_processor.hpp>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

/// `Body` is the mass that the arms carry, and the hand on it:
///     using body = simulation::device<space<double, 3>>;
///     using parameters = mock_parameters<body::parameters_type>;
///     in_memory_transport<mock<body>> cable{parameters{.runs = true, .homed = true}};
template <mock_body Body>
class mock {
 public:
  using mechanism_type = mock_mechanism<Body>;
  using processor_type = mock_processor<mechanism_type>;
  using parameters_type = typename mechanism_type::parameters_type;

  /// The other arguments go to the body.
  template <class... Arguments>
  explicit mock(const parameters_type& parameters = {}, const Arguments&... left) noexcept
      : mechanism_(parameters, left...), processor_(parameters.runs) {}

  void control(request r, std::uint16_t value) noexcept {
    processor_.control(r, value, mechanism_);
  }
  void receive(std::span<const byte> bytes) noexcept { processor_.receive(bytes, mechanism_); }
  [[nodiscard]] std::size_t transmit(std::span<byte> into) noexcept {
    return processor_.transmit(into);
  }
  void elapse(nanoseconds passed) noexcept {
    mechanism_.elapse(std::chrono::duration<double>(passed).count());
    processor_.elapse(passed);
  }
  [[nodiscard]] bool attached() const noexcept { return attached_; }

  /// Pulls the cable only: the motors go on holding their last words, as in the worst case.
  void unplug() noexcept { attached_ = false; }
  void plug_in() noexcept { attached_ = true; }

  [[nodiscard]] mechanism_type& mechanism() noexcept { return mechanism_; }
  [[nodiscard]] const mechanism_type& mechanism() const noexcept { return mechanism_; }
  [[nodiscard]] processor_type& processor() noexcept { return processor_; }
  [[nodiscard]] const processor_type& processor() const noexcept { return processor_; }

 private:
  mechanism_type mechanism_;
  processor_type processor_;
  bool attached_ = true;
};

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
