// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A UDP socket whose only blocking call is wait(). It is for POSIX systems; elsewhere every call fails with ENOTSUP,
// and client and server need another carrier of bytes.
//
//     remote::udp_socket line;
//     const auto here = remote::endpoint::of("0.0.0.0:47600");
//     if (const auto done = line.open(here); !done) puts(describe(done, here).c_str());
//     line.for_each_received([&](remote::received_bytes bytes, const remote::endpoint& from) { … });
//
// After open() only describe() and text() allocate. Addresses are numbers: no name server is asked.

#include <passive_haptics/remote/wire.hpp>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#if defined(__unix__) || defined(__APPLE__)
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#define PASSIVE_HAPTICS_HAS_SOCKETS 1
#endif

namespace passive_haptics {
inline namespace v0 {
namespace remote {

/// An address and a port.
class endpoint {
 public:
  /// No address.
  endpoint() noexcept = default;

  /// An address in numbers, IPv4 or IPv6: "192.168.1.20", "::1"; "0.0.0.0" and "::" are all addresses of this
  /// machine. Port 0 lets the system choose. Any other text gives no address.
  [[nodiscard]] static endpoint of(const char* address, std::uint16_t port) noexcept {
    endpoint made;
#ifdef PASSIVE_HAPTICS_HAS_SOCKETS
    if (::inet_pton(AF_INET, address, &made.four_.sin_addr) == 1) {
      made.four_.sin_family = AF_INET;
      made.four_.sin_port = htons(port);
    } else if (::inet_pton(AF_INET6, address, &made.six_.sin6_addr) == 1) {
      made.six_.sin6_family = AF_INET6;
      made.six_.sin6_port = htons(port);
    }
#else
    static_cast<void>(address);
    static_cast<void>(port);
#endif
    return made;
  }

  /// The endpoint of which text() writes this: "192.168.1.20:47600", "[::1]:47600".
  [[nodiscard]] static endpoint of(std::string_view text) noexcept {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string_view::npos) return {};
    std::string_view address = text.substr(0, colon);
    const std::string_view digits = text.substr(colon + 1);
    if (address.size() > 2 && address.front() == '[' && address.back() == ']') {
      address = address.substr(1, address.size() - 2);
    } else if (address.find(':') != std::string_view::npos) {
      return {};
    }
    std::uint16_t port = 0;
    const auto [rest, wrong] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
    std::array<char, 64> terminated{};
    if (wrong != std::errc{} || rest != digits.data() + digits.size() ||
        address.size() >= terminated.size()) {
      return {};
    }
    std::copy(address.begin(), address.end(), terminated.begin());
    return of(terminated.data(), port);
  }

  /// An address of this machine from which this endpoint can be reached, with a port that the system chooses.
  [[nodiscard]] endpoint from_here() const noexcept {
#ifdef PASSIVE_HAPTICS_HAS_SOCKETS
    if (*this) return of(family() == AF_INET6 ? "::" : "0.0.0.0", 0);
#endif
    return {};
  }

  /// True if there is an address.
  [[nodiscard]] explicit operator bool() const noexcept {
    return family() != 0;
  }
  [[nodiscard]] std::uint16_t port() const noexcept {
#ifdef PASSIVE_HAPTICS_HAS_SOCKETS
    if (family() == AF_INET) return ntohs(four_.sin_port);
    if (family() == AF_INET6) return ntohs(six_.sin6_port);
#endif
    return 0;
  }
  /// Address and port as a `sender`, for a server; all zero if there is no address.
  [[nodiscard]] operator sender() const noexcept {
    sender same{.port = port()};
#ifdef PASSIVE_HAPTICS_HAS_SOCKETS
    if (family() == AF_INET) {
      same.address[10] = same.address[11] = 0xFF;
      std::memcpy(&same.address[12], &four_.sin_addr, 4);
    } else if (family() == AF_INET6) {
      std::memcpy(same.address.data(), &six_.sin6_addr, 16);
    }
#endif
    return same;
  }
  /// "127.0.0.1:47600", "[::1]:47600".
  [[nodiscard]] std::string text() const {
#ifdef PASSIVE_HAPTICS_HAS_SOCKETS
    std::array<char, INET6_ADDRSTRLEN> digits{};
    const bool six = family() == AF_INET6;
    const void* const number =
        six ? static_cast<const void*>(&six_.sin6_addr) : static_cast<const void*>(&four_.sin_addr);
    if (family() != 0 && ::inet_ntop(family(), number, digits.data(), digits.size()) != nullptr) {
      return (six ? "[" : "") + std::string(digits.data()) + (six ? "]:" : ":") +
             std::to_string(port());
    }
#endif
    return "no address";
  }

 private:
  friend class udp_socket;
#ifdef PASSIVE_HAPTICS_HAS_SOCKETS
  [[nodiscard]] int family() const noexcept {
    return four_.sin_family != 0 ? four_.sin_family : six_.sin6_family;
  }
  [[nodiscard]] const sockaddr* address() const noexcept {
    return family() == AF_INET6 ? reinterpret_cast<const sockaddr*>(&six_)
                                : reinterpret_cast<const sockaddr*>(&four_);
  }
  [[nodiscard]] socklen_t length() const noexcept {
    return family() == AF_INET6 ? sizeof six_ : sizeof four_;
  }
  [[nodiscard]] static endpoint of(const sockaddr_storage& there) noexcept {
    endpoint made;
    if (there.ss_family == AF_INET) std::memcpy(&made.four_, &there, sizeof made.four_);
    if (there.ss_family == AF_INET6) std::memcpy(&made.six_, &there, sizeof made.six_);
    return made;
  }

  sockaddr_in four_{};  // at most one of the two has a family
  sockaddr_in6 six_{};
#else
  [[nodiscard]] static int family() noexcept {
    return 0;
  }
#endif
};

/// The result of a call. It converts to true if the call succeeded.
struct [[nodiscard]] udp_result {
  enum class call : std::uint8_t { none, open, send, receive, wait };
  call failed = call::none;
  int error = 0;  ///< errno

  constexpr explicit operator bool() const noexcept { return failed == call::none; }
};

/// The remedy of an error of the system; empty if there is none.
[[nodiscard]] constexpr const char* remedy(const udp_result& r) noexcept {
  switch (r.error) {
    case EADDRINUSE:
      return "end the program that holds the port, or take another; with port 0 the system chooses";
    case EADDRNOTAVAIL:
      return "no address of this machine: 127.0.0.1 and ::1 are for programs on it, 0.0.0.0 and :: "
             "for everybody";
    case EACCES:
      return "not allowed: take a port above 1023, and no broadcast address";
    case EPERM:
      return "not allowed: look at the firewall of this machine";
    case ENETUNREACH:
    case EHOSTUNREACH:
    case ENETDOWN:
      return "look at cable, address and route; sending again is all that is needed once they work";
    case EAFNOSUPPORT:
    case EINVAL:
      return "give an address in numbers, at both ends of the same kind, IPv4 or IPv6";
    case EDESTADDRREQ:
      return "give an address in numbers and a port, as in 192.168.1.20:47600 or [fd00::20]:47600";
    case EBADF:
      return "open() it first";
    case EMFILE:
    case ENFILE:
      return "close some files, or raise ulimit -n";
    case ECONNREFUSED:
      return "nobody listens there: start the server";
    case ENOTSUP:
      return "this system has no POSIX sockets: send the bytes by its own";
    default:
      return "";
  }
}

/// The whole sentence: what failed, where, why, and what to do.
[[nodiscard]] inline std::string describe(const udp_result& r, const endpoint& at) {
  constexpr std::array what{"udp", "udp: open at ", "udp: send to ", "udp: receive at ",
                            "udp: wait at "};
  if (r) return "ok";
  std::string text = what[static_cast<std::size_t>(r.failed)] + at.text() + ": " +
                     std::generic_category().message(r.error) + " (" + std::to_string(r.error) +
                     ")";
  if (const char* help = remedy(r); *help != '\0') text += std::string(": ") + help;
  return text;
}

/// One socket, closed with the object. Any thread may use it, one at a time.
class udp_socket {
 public:
  udp_socket() noexcept = default;
  udp_socket(udp_socket&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  udp_socket& operator=(udp_socket&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
  }
  ~udp_socket() { close(); }

  [[nodiscard]] bool is_open() const noexcept { return file_ >= 0; }

#ifdef PASSIVE_HAPTICS_HAS_SOCKETS
  /// Listens at an address of this machine. A socket that is open is closed first.
  udp_result open(const endpoint& here) noexcept {
    close();
    if (!here) return {udp_result::call::open, EDESTADDRREQ};
    file_ = ::socket(here.family(), SOCK_DGRAM, 0);
    if (file_ < 0) return failed(udp_result::call::open);
    const int flags = ::fcntl(file_, F_GETFL, 0);
    if (flags < 0 || ::fcntl(file_, F_SETFL, flags | O_NONBLOCK) < 0 ||
        ::fcntl(file_, F_SETFD, FD_CLOEXEC) < 0 ||
        ::bind(file_, here.address(), here.length()) < 0) {
      const auto why = failed(udp_result::call::open);
      close();
      return why;
    }
    return {};
  }
  void close() noexcept {
    if (file_ >= 0) ::close(file_);
    file_ = -1;
  }

  /// Its own address, with the port that the system has chosen.
  [[nodiscard]] endpoint here() const noexcept {
    sockaddr_storage mine{};
    socklen_t length = sizeof mine;
    if (::getsockname(file_, reinterpret_cast<sockaddr*>(&mine), &length) < 0) return {};
    return endpoint::of(mine);
  }

  /// Hands a datagram to the system, which may lose it as the network may: a full queue (EAGAIN, ENOBUFS)
  /// is no failure.
  udp_result send(received_bytes bytes, const endpoint& to) noexcept {
    if (!to) return {udp_result::call::send, EDESTADDRREQ};
    if (::sendto(file_, bytes.data(), bytes.size(), 0, to.address(), to.length()) >= 0) return {};
    if (would_wait() || errno == ENOBUFS) return {};
    return failed(udp_result::call::send);
  }

  /// Calls act(bytes, from) for each datagram that has come, up to 256: the rest wait for the next call, so
  /// that a flood does not keep the thread. A datagram that is too long is cut to 217 bytes, one more than the
  /// longest seal makes of it.
  template <class Act>
  udp_result for_each_received(Act act) {
    for (int n = 0; n < 256; ++n) {
      std::array<std::byte, datagram_size + longest_seal + 1> room{};
      sockaddr_storage there{};
      socklen_t length = sizeof there;
      const auto size = ::recvfrom(file_, room.data(), room.size(), 0,
                                   reinterpret_cast<sockaddr*>(&there), &length);
      if (size >= 0) {
        act(received_bytes(room.data(), static_cast<std::size_t>(size)), endpoint::of(there));
      } else if (would_wait()) {
        return {};
      } else if (errno != EINTR && errno != ECONNREFUSED) {  // of an earlier send
        return failed(udp_result::call::receive);
      }
    }
    return {};
  }

  /// Waits until a datagram or a signal comes, or the time is over.
  udp_result wait(std::chrono::milliseconds most) noexcept {
    pollfd one{.fd = file_, .events = POLLIN, .revents = 0};
    if (file_ < 0) return {udp_result::call::wait, EBADF};
    if (::poll(&one, 1, static_cast<int>(most.count())) < 0 && errno != EINTR) {
      return failed(udp_result::call::wait);
    }
    return {};
  }

 private:
  static udp_result failed(udp_result::call what) noexcept {
    return {what, errno};
  }
  [[nodiscard]] static bool would_wait() noexcept {
#if EAGAIN != EWOULDBLOCK
    if (errno == EWOULDBLOCK) return true;
#endif
    return errno == EAGAIN;
  }
#else
  udp_result open(const endpoint& /*here*/) noexcept {
    return {udp_result::call::open, ENOTSUP};
  }
  void close() noexcept {}
  [[nodiscard]] endpoint here() const noexcept {
    return {};
  }
  udp_result send(received_bytes /*bytes*/, const endpoint& /*to*/) noexcept {
    return {udp_result::call::send, ENOTSUP};
  }
  template <class Act>
  udp_result for_each_received(Act /*act*/) {
    return {udp_result::call::receive, ENOTSUP};
  }
  udp_result wait(std::chrono::milliseconds /*most*/) noexcept {
    return {udp_result::call::wait, ENOTSUP};
  }

 private:
#endif
  int file_ = -1;
};

}  // namespace remote
}  // namespace v0
}  // namespace passive_haptics

#ifdef PASSIVE_HAPTICS_HAS_SOCKETS
#undef PASSIVE_HAPTICS_HAS_SOCKETS
#endif
