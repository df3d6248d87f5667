// SPDX-License-Identifier: BSD-3-Clause
#include "support/catch.hpp"
#include "support/scratch_folder.hpp"
#include "support/scripted_falcon.hpp"

#include <cstdio>
#include <string>

TEST_CASE("an image is checked to its last byte before it is sent", "[falcon][boot]") {
  const auto good = synthetic_image();
  const auto summary = falcon::check_image(good);
  REQUIRE(summary.how);
  CHECK(summary.entry == 0x3F8002);
  CHECK(summary.blocks == 2);
  CHECK(summary.words == 600);
  for (std::size_t length = 0; length < good.size(); ++length) {
    if (falcon::check_image(std::span(good).first(length)).how) FAIL(length);
  }
  CHECK(falcon::check_image({}).how.what == falcon::code::image_missing);
  auto longer = good;
  longer.push_back(0);
  CHECK(falcon::check_image(longer).how.what == falcon::code::image_trailing);
  auto other_key = good;
  other_key[0] = 0xAB;
  CHECK(falcon::check_image(other_key).how.what == falcon::code::image_wrong_key);
  CHECK(falcon::check_image(other_key).how.value == 0x08AB);
  auto too_long_block = good;
  too_long_block[23] = 0xFF;
  CHECK(falcon::check_image(too_long_block).how.what == falcon::code::image_truncated);
  CHECK(falcon::check_image(too_long_block).how.value == 22);
}

TEST_CASE("a firmware file is read whole or refused", "[falcon][boot]") {
  const scratch_folder folder;
  const std::string path = folder / "firmware.bin";
  const auto write = [&path](const std::vector<falcon::byte>& bytes) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    REQUIRE(file != nullptr);
    CHECK(std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size());
    std::fclose(file);
  };
  falcon::firmware image;
  CHECK(image.load("no/such/file").what == falcon::code::image_unreadable);
  CHECK(image.load(nullptr).what == falcon::code::image_unreadable);
  const auto good = synthetic_image();
  write(good);
  CHECK(image.load(path.c_str()));
  CHECK(std::vector<falcon::byte>(image.bytes().begin(), image.bytes().end()) == good);
  write({1, 2, 3});
  CHECK(image.load(path.c_str()).what == falcon::code::image_wrong_key);
  CHECK(image.bytes().empty());
  write(std::vector<falcon::byte>(falcon::firmware::capacity + 1, 0xAA));
  CHECK(image.load(path.c_str()).what == falcon::code::image_too_long);
}
