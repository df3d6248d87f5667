// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Recordings as CSV, one row per call of the transport:
//
//   stamp_ns,call,code,value,modem,line,bytes,leg0,leg1,leg2,flags
//   1250000,write,0,0,1,96,3C414141…3E,0,0,0,1
//
// `call` is control, write or read, `code` and `value` are the result, `bytes` are hexadecimal. The last four
// columns are for people: the motor words or encoder counts of a packet, and its flags.

#include <passive_haptics/base/kernels.hpp>
#include <passive_haptics/falcon/recording.hpp>

#include <charconv>
#include <cstdio>
#include <string_view>

namespace passive_haptics {
inline namespace v0 {
namespace falcon {

namespace detail {

inline constexpr std::array<const char*, 3> call_names{"control", "write", "read"};
inline constexpr const char* log_heading =
    "stamp_ns,call,code,value,modem,line,bytes,leg0,leg1,leg2,flags\n";

inline void print_row(std::FILE* file, const wire_row& row) noexcept {
  std::fprintf(file, "%lld,%s,%d,%lld,%d,%d,", static_cast<long long>(row.stamp.count()),
               call_names[static_cast<std::size_t>(row.what)], static_cast<int>(row.how.what),
               static_cast<long long>(row.how.value), row.lines.modem, row.lines.line);
  for (const byte b : row.content()) std::fprintf(file, "%02X", b);
  packet_bytes bytes{};
  std::copy_n(row.bytes.begin(), packet_size, bytes.begin());
  const bool out = row.what == wire_row::call::write;
  const auto sent = decode<to_device>(bytes);
  const auto received = decode<from_device>(bytes);
  if (row.count == packet_size && (out ? sent.has_value() : received.has_value())) {
    for (const int word : out ? sent->motor : received->encoder) std::fprintf(file, ",%d", word);
    std::fprintf(file, ",%d", out ? flags_of(*sent) : flags_of(*received));
  } else {
    std::fputs(",,,,", file);
  }
  std::fputc('\n', file);
}

/// Splits a line at its commas and reads its fields; good() is false after the first field that is wrong.
class row_reader {
 public:
  explicit row_reader(std::string_view line) noexcept : rest_(line) {}

  std::string_view field() noexcept {
    const std::size_t comma = rest_.find(',');
    const std::string_view part = rest_.substr(0, comma);
    good_ = good_ && comma != std::string_view::npos;
    rest_ = good_ ? rest_.substr(comma + 1) : std::string_view{};
    return part;
  }

  template <class Integer>
  Integer number(long long least, long long most) noexcept {
    return static_cast<Integer>(number_in(field(), 10, least, most));
  }

  wire_row::call call() noexcept {
    const std::string_view name = field();
    for (std::size_t i = 0; i < call_names.size(); ++i) {
      if (name == call_names[i]) return static_cast<wire_row::call>(i);
    }
    good_ = false;
    return {};
  }

  byte hexadecimal(std::array<byte, ftdi::usb_packet>& bytes) noexcept {
    const std::string_view text = field();
    good_ = good_ && text.size() % 2 == 0 && text.size() / 2 <= bytes.size();
    if (!good_) return 0;
    for (std::size_t i = 0; i < text.size() / 2; ++i) {
      bytes[i] = static_cast<byte>(number_in(text.substr(2 * i, 2), 16, 0, 255));
    }
    return static_cast<byte>(text.size() / 2);
  }

  [[nodiscard]] bool good() const noexcept { return good_; }

 private:
  long long number_in(std::string_view text, int base, long long least, long long most) noexcept {
    long long value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value, base);
    good_ = good_ && error == std::errc{} && stop == end && value >= least && value <= most;
    return good_ ? value : least;
  }

  std::string_view rest_;
  bool good_ = true;
};

[[nodiscard]] inline bool parse_row(std::string_view line, wire_row& row) noexcept {
  constexpr auto most = kernels::largest<std::int64_t>();
  row_reader read(line);
  row.stamp = nanoseconds(read.number<std::int64_t>(0, most));
  row.what = read.call();
  row.how.what = read.number<code>(0, static_cast<int>(code::log_full));
  row.how.value = read.number<std::int64_t>(-most, most);
  row.lines.modem = read.number<byte>(0, 255);
  row.lines.line = read.number<byte>(0, 255);
  row.count = read.hexadecimal(row.bytes);
  return read.good();
}

}  // namespace detail

/// Writes the rows; returns log_unwritable if that fails.
inline result save(const char* path, std::span<const wire_row> rows) noexcept {
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) return {code::log_unwritable};
  std::fputs(detail::log_heading, file);
  for (const wire_row& row : rows) detail::print_row(file, row);
  const bool failed = std::ferror(file) != 0;
  return std::fclose(file) != 0 || failed ? result{code::log_unwritable} : result{};
}

struct loaded_log {
  result how{};  ///< ok, or log_unreadable with the line in `value`, 0 if there is no file
  std::vector<wire_row> rows;
};

/// Reads what save() wrote.
[[nodiscard]] inline loaded_log load(const char* path) {
  loaded_log log;
  std::FILE* file = std::fopen(path, "r");
  if (file == nullptr) return {{code::log_unreadable}, {}};
  std::array<char, 512> text{};
  for (std::int64_t line = 1; std::fgets(text.data(), text.size(), file) != nullptr; ++line) {
    wire_row row;
    const bool heading = line == 1;
    const bool good = heading ? std::string_view(text.data()) == detail::log_heading
                              : detail::parse_row(text.data(), row);
    if (!good) {
      log.how = {code::log_unreadable, line};
      break;
    }
    if (!heading) log.rows.push_back(row);
  }
  std::fclose(file);
  return log;
}

}  // namespace falcon
}  // namespace v0
}  // namespace passive_haptics
