// SPDX-License-Identifier: Apache-2.0
// The program store: names, numbers, replacing, asking the host (M700 13.3.1).
#include "program/store.hpp"

#include <gtest/gtest.h>

#include <string>

#include "lex_helpers.hpp"

namespace nc::test {
namespace {

TEST(ProgramStore, NumbersFromNames) {
  Texts t;
  const struct {
    const char* name;
    uint32_t number;
  } rows[] = {{"O1000", 1000},
              {"2000", 2000},
              {"3000.nc", 3000},
              {"sub/dir/o0400.NC", 400},
              {"C:\\parts\\O12345678.txt", 12345678},
              {"0100", 100},  // so a program reads it; a call does not find it by this number
              {"part-1", 0},
              {"O123456789", 0},
              {"O", 0},
              {"O12a", 0}};
  for (const auto& row : rows)
    EXPECT_EQ(t.store.entry(t.add_memory(row.name, "G1\n"))->number, row.number) << row.name;
  EXPECT_EQ(t.store.find_number(3000), 2);
  EXPECT_EQ(t.store.find_number(100), -1);
  EXPECT_EQ(t.store.find_number(0), -1);
}

// The letter of program numbers is the family's, in names of files as in texts; O where its texts have none.
TEST(ProgramStore, NumbersHaveTheLetterOfTheFamily) {
  for (const char letter : {'L', '\0'}) {
    IsoRules rules = m700_rules();
    rules.program_letter = letter;
    Texts t(65536, 32, rules);
    const std::string with_l = letter != 0 ? "L" : "O", other = letter != 0 ? "O" : "L";
    EXPECT_EQ(t.store.entry(t.add_memory((with_l + "20.nc").c_str(), "G1\n"))->number, 20u);
    EXPECT_EQ(t.store.entry(t.add_memory((other + "30.nc").c_str(), "G1\n"))->number, 0u);
    EXPECT_EQ(t.store.entry(t.add_memory("40.nc", "G1\n"))->number, 40u);
    std::string asked;
    t.store.on_missing([](void* user, nc_control*, const char* name) { return *static_cast<std::string*>(user) += std::string(name) + " ", false; }, &asked, nullptr);
    EXPECT_FALSE(t.reader.find_program(5, t.add_memory("main.nc", "M30\n")).valid());
    EXPECT_FALSE(t.reader.find_external("198:", nullptr, 0, 6).valid());
    EXPECT_EQ(asked, with_l + "5 198:" + with_l + "6 ");
  }
}

TEST(ProgramStore, NamesIgnoreCaseFolderAndAMissingEnding) {
  Texts t;
  const int a = static_cast<int>(t.add_memory("dir/Parts-12.RAF", "G1\n"));
  const int b = static_cast<int>(t.add_memory("parts-12.nc", "G1\n"));
  const int c = static_cast<int>(t.add_memory("plain", "G1\n"));
  EXPECT_EQ(t.store.find_name("PARTS-12.raf", 12), a);
  EXPECT_EQ(t.store.find_name("x/parts-12.NC", 13), b);
  EXPECT_EQ(t.store.find_name("parts-12", 8), a);
  EXPECT_EQ(t.store.find_name("PLAIN.nc", 8), c);
  EXPECT_EQ(t.store.find_name("parts-12.txt", 12), -1);
  EXPECT_EQ(t.store.find_name("parts", 5), -1);
}

TEST(ProgramStore, SameNameReplaces) {
  Texts t;
  const unsigned a = t.add_memory("O1", "G1\n");
  const uint32_t before = t.store.entry(a)->generation;
  EXPECT_EQ(t.add_memory("o1", "G2\n"), a);
  EXPECT_NE(t.store.entry(a)->generation, before);
}

TEST(ProgramStore, Refuses) {
  Texts t;
  TextEntry entry;
  entry.memory = "G1\n";
  entry.size = 3;
  EXPECT_EQ(t.store.add(entry, nullptr, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(t.store.add(entry, "", nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(t.store.add(entry, "dir/", nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(t.store.add(entry, std::string(NC_MAX_NAME, 'a').c_str(), nullptr), NC_E_ARGUMENT);
  entry.memory = nullptr;
  EXPECT_EQ(t.store.add(entry, "a", nullptr), NC_E_ARGUMENT);
  for (int i = 0; i < 16; ++i) t.add_memory("p" + std::to_string(i), "G1\n");
  entry.memory = "G1\n";
  EXPECT_EQ(t.store.add(entry, "one more", nullptr), NC_E_MEMORY);
  EXPECT_EQ(t.store.add(entry, "p3", nullptr), NC_OK);
  EXPECT_EQ(t.store.entry(16), nullptr);
}

TEST(ProgramStore, AsksTheHost) {
  Texts t;
  EXPECT_FALSE(t.store.ask_host("O5"));
  struct Host {
    Texts* texts;
    std::string asked;
  } host{&t, ""};
  t.store.on_missing(
      [](void* user, nc_control*, const char* name) {
        Host& h = *static_cast<Host*>(user);
        h.asked += std::string(name) + " ";
        if (std::string(name) == "O7") return true;  // claims that it has added the program, but has not
        if (std::string(name) != "O5" && std::string(name) != "TOOL.NC") return false;
        h.texts->add_memory(std::string("host/") + name, "G1\nM99\n");
        return true;
      },
      &host, nullptr);
  const unsigned main = t.add_memory("main.nc", "M98 P5\nM30\n");
  const ProgramRef five = t.reader.find_program(5, main);
  EXPECT_TRUE(five.valid());
  EXPECT_EQ(five.number, 5u);
  EXPECT_EQ(five.offset, 0u);
  EXPECT_TRUE(t.reader.find_program(5, main).valid());  // not asked again
  EXPECT_FALSE(t.reader.find_program(6, main).valid());
  EXPECT_FALSE(t.reader.find_program(7, main).valid());
  EXPECT_FALSE(t.reader.find_program(0, main).valid());
  EXPECT_TRUE(t.reader.find_program("TOOL.NC", 7).valid());
  EXPECT_FALSE(t.reader.find_program("OTHER", 5).valid());
  EXPECT_FALSE(t.reader.find_program(std::string(NC_MAX_NAME, 'A').c_str(), NC_MAX_NAME).valid());  // longer than any file's name
  EXPECT_EQ(host.asked, "O5 O6 O7 TOOL.NC OTHER ");
}

}  // namespace
}  // namespace nc::test
