// SPDX-License-Identifier: Apache-2.0
// What a text shows of a block to the reader of its family (nc_block_words).
#include <gtest/gtest.h>

#include <string>

#include "nc/nc.h"

namespace {

struct Read {
  nc_status status = NC_OK;
  nc_block_text block = NC_INIT(nc_block_text);
  nc_plain_word words[NC_MAX_WORDS];
};

Read read_block(nc_dialect dialect, const std::string& text, bool data = false) {
  Read read;
  read.block.data = data;
  read.status = nc_block_words(dialect, "XYZ", text.data(), text.size(), &read.block, read.words);
  return read;
}

/// Letter, kind and text of each word.
std::string shown(const Read& read, const std::string& text) {
  std::string all;
  for (unsigned i = 0; i < read.block.count; ++i) {
    const nc_plain_word& word = read.words[i];
    all += std::string(all.empty() ? "" : " ") + (word.comma ? "," : "") + text.substr(word.begin, word.end - word.begin) + ":" + std::to_string(word.kind);
  }
  return all;
}

TEST(BlockWords, AreThoseOfTheFamilysReader) {
  const std::string text = "N10 G90g1 X1.5(G4) y-2 ,R3 F#100 Z[1+2] S5\nG2\n";
  const Read m700 = read_block(NC_DIALECT_M700, text);
  EXPECT_EQ(shown(m700, text), "G90:3 g1:3 X1.5:1 y-2:1 ,R3:1 S5:0");
  EXPECT_EQ(m700.block.used, text.find('\n') + 1);
  EXPECT_FALSE(m700.block.fault);
  EXPECT_TRUE(m700.words[2].point);
  EXPECT_FALSE(m700.words[3].point);
  EXPECT_EQ(m700.words[3].value, -2);
  const Read dgshape = read_block(NC_DIALECT_DGSHAPE, text);  // it has no words behind a comma
  EXPECT_TRUE(dgshape.block.fault);
  EXPECT_EQ(shown(dgshape, text), "G90:3 g1:3 X1.5:1 y-2:1");
}

TEST(BlockWords, HaveTheKindThatTheirCodesGive) {
  const std::string dwell = "G04 P1.500", data = "P1001 X5.";
  EXPECT_EQ(shown(read_block(NC_DIALECT_M700, dwell), dwell), "G04:3 P1.500:2");
  EXPECT_EQ(shown(read_block(NC_DIALECT_M700, data, true), data), "P1001:0 X5.:0");
  EXPECT_TRUE(read_block(NC_DIALECT_M700, "G10 L70").block.data);
  EXPECT_FALSE(read_block(NC_DIALECT_M700, "G11", true).block.data);
}

TEST(BlockWords, EndWithTheirBlock) {
  for (const std::string text : {"\n", "%", "(", ";", "#", " ", "G1"}) {
    const Read read = read_block(NC_DIALECT_ISO, text);
    EXPECT_EQ(read.status, NC_OK) << text;
    EXPECT_EQ(read.block.used, text.size()) << text;
  }
  std::string wide(400, ' ');
  wide += "X5";
  const Read read = read_block(NC_DIALECT_M700, wide);
  ASSERT_EQ(read.block.count, 1u);
  EXPECT_EQ(read.words[0].end, 0u) << "its place is not known";
}

TEST(BlockWords, RefuseWhatIsNotValid) {
  Read read;
  EXPECT_EQ(nc_block_words(NC_DIALECT_COUNT, "X", "G1", 2, &read.block, read.words), NC_E_ARGUMENT);
  EXPECT_EQ(nc_block_words(NC_DIALECT_ISO, nullptr, "G1", 2, &read.block, read.words), NC_E_ARGUMENT);
  EXPECT_EQ(nc_block_words(NC_DIALECT_ISO, "X", nullptr, 2, &read.block, read.words), NC_E_ARGUMENT);
  EXPECT_EQ(nc_block_words(NC_DIALECT_ISO, "X", "G1", 0, &read.block, read.words), NC_E_ARGUMENT);
  EXPECT_EQ(nc_block_words(NC_DIALECT_ISO, "X", "G1", 2, nullptr, read.words), NC_E_ARGUMENT);
  EXPECT_EQ(nc_block_words(NC_DIALECT_ISO, "X", "G1", 2, &read.block, nullptr), NC_E_ARGUMENT);
  read.block.struct_size = 2;
  EXPECT_EQ(nc_block_words(NC_DIALECT_ISO, "X", "G1", 2, &read.block, read.words), NC_E_ARGUMENT);
}

}  // namespace
