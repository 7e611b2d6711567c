// SPDX-License-Identifier: Apache-2.0
// Auxiliary functions of a block by what they mean: by the table of the family, and where parameters give another meaning.
#include "command/auxiliary.hpp"

#include "front_end_helpers.hpp"

namespace nc::test {
namespace {

class AuxiliaryTest : public FrontEndTest {
 protected:
  const Auxiliary& one(const std::string& text) {
    EXPECT_EQ(read(text), Reading::done) << text;
    EXPECT_EQ(command.auxiliary.size(), 1u) << text;
    return command.auxiliary[0];
  }
};

TEST_F(AuxiliaryTest, MeansWhatTheTableOfTheFamilySays) {
  EXPECT_EQ(one("M30").function, MiscFunction::program_end);
  EXPECT_EQ(one("M98 P1").function, MiscFunction::call_sub);
  EXPECT_FALSE(command.auxiliary[0].is_output());
  EXPECT_EQ(one("M77").function, MiscFunction::output);  // in no row
  EXPECT_EQ(command.auxiliary[0].number, 77u);
  EXPECT_TRUE(command.auxiliary[0].is_output());
}

// M700 13.12: M96 and M97 are taken by the control only where it has the macro interrupt, and #1110, #1111 may name other codes.
TEST_F(AuxiliaryTest, SwitchesTheInterruptOnlyByTheCodesOfTheParameters) {
  EXPECT_FALSE(one("M96 P1").switches_interrupt());
  EXPECT_TRUE(command.auxiliary[0].is_output());
  misc_codes.interrupt_on = 40;
  misc_codes.interrupt_off = 41;
  EXPECT_EQ(one("M40").function, MiscFunction::interrupt_on);
  EXPECT_FALSE(command.auxiliary[0].is_output());
  EXPECT_EQ(one("M41").function, MiscFunction::interrupt_off);
  EXPECT_FALSE(one("M96 P1").switches_interrupt());
}

TEST_F(AuxiliaryTest, TapsAndEndsReadingAndIsPutOutAllTheSame) {
  misc_codes.synchronous_tap = 29;
  misc_codes.reading_stops[3] = 7;
  misc_codes.any_reading_stop = true;
  EXPECT_TRUE(one("M29").taps_synchronously);
  EXPECT_TRUE(command.auxiliary[0].is_output());
  EXPECT_FALSE(command.auxiliary[0].stops_reading);
  EXPECT_TRUE(one("M7").stops_reading);
  EXPECT_TRUE(command.auxiliary[0].is_output());
  EXPECT_FALSE(one("M0").stops_reading);  // an entry of 0 is none
}

}  // namespace
}  // namespace nc::test
