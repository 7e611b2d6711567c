// SPDX-License-Identifier: Apache-2.0
// A program that is taken back to each of its marks and goes on from there as it did.
#pragma once

#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {

/// Every mark of the run is a place to go on from.
inline void goes_on_from_every_mark(const std::string& text, const std::function<void(Bench&)>& change = [](Bench&) {},
    const std::function<void(nc_config&)>& machine = {}) {
  SCOPED_TRACE(text);
  Bench bench(NC_DIALECT_M700, machine);
  change(bench);
  const Outcome run = bench.run(text);
  ASSERT_EQ(run.alarm, "") << run.alarm_detail;
  for (const Step& step : run.steps) {
    if (step.item.kind != NC_ITEM_MARK || !step.item.u.mark.report) continue;
    ASSERT_EQ(bench.rewind(step.item.serial, step.machine), NC_OK);
    const Outcome rest = bench.finish();
    ASSERT_EQ(rest.steps.size(), run.steps.size() - step.item.serial) << "from line " << step.item.source.line;
    for (size_t i = 0; i < rest.steps.size(); ++i) ASSERT_EQ(exactly(rest.steps[i]), exactly(run.steps[step.item.serial + i])) << "from line " << step.item.source.line;
  }
}

}  // namespace nc::test
