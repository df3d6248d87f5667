// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A sentence for every check that does not hold; the exit code counts them.

#include "../replay/text.hpp"

class checks {
 public:
  void operator()(bool holds, const char* subject, const char* sentence) {
    ++made_;
    if (holds) return;
    ++failed_;
    text_line().words("not so:", subject, sentence).print();
  }
  [[nodiscard]] int result() const {
    text_line().number(made_).words("checks,").number(failed_).words("failed").print();
    return failed_ == 0 && made_ > 0 ? 0 : 1;
  }

 private:
  std::uint32_t made_ = 0, failed_ = 0;
};
