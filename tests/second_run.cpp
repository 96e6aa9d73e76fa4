#include "second_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>

namespace etd {

void expect_in_two_runs(const std::string& name, const std::function<Objections(const TestRun&)>& run) {
  const Objections first = run({});
  if (first.empty()) return;
  const std::string said = fmt::format("{}, first run:\n  {}\n", name, fmt::join(first, "\n  "));
  std::cout << said << "once more with four times the samples" << std::endl;
  const Objections second = run({4, 10000});
  if (!second.empty())
    ADD_FAILURE() << said << "second run, four times the samples:\n  " << fmt::format("{}", fmt::join(second, "\n  "));
}

}  // namespace etd
