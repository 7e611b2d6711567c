// SPDX-License-Identifier: Apache-2.0
// Random rungs are compared with an oracle that reads the same text line by line and needs only a list of results: LD
// appends one, ANB and ORB join the last two, MPS keeps one, and every contact looks into a map of names. It has no
// cells, no compiled code and no image.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <optional>
#include <sstream>

#include "rig.hpp"

namespace nc::ladder {
namespace {

struct Oracle {
  std::map<std::string, bool> device;
  std::map<unsigned, std::optional<bool>> memory;  // the last level at the edge in each line
  std::map<unsigned, bool> power;                  // of each line but MCR in the last scan: its result, or of an output what is in front of it

  bool edge(unsigned line, bool now, bool rising) {
    const std::optional<bool> before = memory[line];
    memory[line] = now;
    return before && *before != now && now == rising;
  }
  void scan(const std::string& text) {
    std::vector<bool> results{false};
    std::vector<bool> kept;
    std::vector<bool> masters;  // conditions of MC, which act on a whole result, not within its blocks
    unsigned blocks = 0;        // number of blocks that were begun since the last output
    bool used = true;           // the line before was an output
    std::istringstream lines(text);
    std::string line;
    for (unsigned n = 1; std::getline(lines, line); ++n) {
      std::istringstream words(line);
      std::string name, operand, second;
      words >> name >> operand >> second;
      std::string join = name;
      bool contact = device[operand];
      if (name == "LDP" || name == "ANDP" || name == "ORP") contact = edge(n, contact, true), join.pop_back();
      if (name == "LDF" || name == "ANDF" || name == "ORF")
        contact = edge(n, contact, false), join.pop_back();
      if (name == "LDI" || name == "ANI" || name == "ORI") contact = !contact;
      if (name == "ANI") join = "AND";
      if (name == "LDI" || name == "ORI") join.pop_back();
      bool on = results.back();
      if (blocks == 1)
        for (const bool master : masters) on = on && master;
      const bool output = join != "LD" && join != "AND" && join != "OR" && name != "ANB" && name != "ORB" &&
                          name != "INV" && name != "MEP" && name != "MEF" && name != "MRD" && name != "MPP";
      if (join == "LD")
        results.push_back(contact), blocks = used ? 1 : blocks + 1;
      else if (join == "AND")
        results.back() = results.back() && contact;
      else if (join == "OR")
        results.back() = results.back() || contact;
      else if (name == "ANB" || name == "ORB") {
        const bool last = results.back();
        results.pop_back();
        if (blocks > 1) --blocks;
        results.back() = name == "ANB" ? results.back() && last : results.back() || last;
      } else if (name == "INV")
        results.back() = !on;
      else if (name == "MEP")
        results.back() = edge(n, on, true);
      else if (name == "MEF")
        results.back() = edge(n, on, false);
      else if (name == "MPS")
        kept.push_back(on);
      else if (name == "MRD")
        results.back() = kept.back(), blocks = 1;
      else if (name == "MPP")
        results.back() = kept.back(), kept.pop_back(), blocks = 1;
      else if (name == "OUT")
        device[operand] = on;
      else if (name == "SET")
        device[operand] = on || device[operand];
      else if (name == "RST")
        device[operand] = !on && device[operand];
      else if (name == "PLS")
        device[operand] = edge(n, on, true);
      else if (name == "PLF")
        device[operand] = edge(n, on, false);
      else if (name == "FF")
        device[operand] = device[operand] != edge(n, on, true);
      else if (name == "SETP")
        device[operand] = edge(n, on, true) || device[operand];
      else if (name == "RSTP")
        device[operand] = !edge(n, on, true) && device[operand];
      else if (name == "MC")
        device[second] = on, masters.push_back(on);
      else if (name == "MCR")
        masters.pop_back();
      else
        FAIL() << "the oracle does not know " << line;
      used = output && name != "MPS";
      if (output) results.back() = on;  // what goes on from an output, or into a branch, goes by the master controls, too
      if (name != "MCR") power[n] = results.back();
    }
  }
};

// Writes rungs from a series of choices, and only those that the language allows.
class Writer {
 public:
  explicit Writer(const std::vector<std::uint16_t>& choices) : choices_(choices) {}

  std::string program() {
    while (at_ < choices_.size()) {
      rung();
      if (masters_ < 2 && pick(8) == 0) {
        logic(2);
        line("MC N" + std::to_string(masters_) + " M" + std::to_string(90 + masters_));
        ++masters_;
      } else if (masters_ > 0 && pick(4) == 0) {
        line("MCR N" + std::to_string(--masters_));
      }
    }
    while (masters_ > 0) line("MCR N" + std::to_string(--masters_));
    return text_;
  }

 private:
  unsigned pick(unsigned n) { return at_ < choices_.size() ? choices_[at_++] % n : 0; }
  void line(const std::string& text) { text_ += text + "\n"; }
  std::string contact() {
    static const char* const kKinds[] = {"X", "Y", "M", "D0."};
    return kKinds[pick(4)] + std::to_string(pick(6));
  }
  std::string coil() {
    static const char* const kKinds[] = {"Y", "M", "D0."};
    return kKinds[pick(3)] + std::to_string(pick(6));
  }
  void one(const char* const* names, unsigned count) {
    line(std::string(names[pick(count)]) + " " + contact());
  }

  // Writes a result made of contacts and blocks.
  void logic(unsigned depth) {
    static const char* const kLoads[] = {"LD", "LDI", "LD", "LDI", "LDP", "LDF"};
    one(kLoads, 6);
    more(depth, true);
  }
  // Writes what may follow a result; `parallel`: that may be a parallel contact or block.
  void more(unsigned depth, bool parallel) {
    static const char* const kSeries[] = {"AND", "ANI", "ANDP", "ANDF"};
    static const char* const kParallel[] = {"OR", "ORI", "ORP", "ORF"};
    for (unsigned n = pick(4); n > 0; --n) {
      const unsigned what = pick(8);
      if (what < 3)
        one(kSeries, 4);
      else if (what < 5 && parallel)
        one(kParallel, 4);
      else if (what == 5)
        line("INV");
      else if (what == 6)
        line(pick(2) == 0 ? "MEP" : "MEF");
      else if (depth > 0) {
        logic(depth - 1);
        line(parallel && pick(2) == 0 ? "ORB" : "ANB");
      }
    }
  }
  void outputs() {
    static const char* const kNames[] = {"OUT", "SET", "RST", "OUT", "PLS", "PLF", "FF", "SETP", "RSTP"};
    for (unsigned n = 1 + pick(3); n > 0; --n) line(std::string(kNames[pick(9)]) + " " + coil());
  }
  void branches(unsigned depth) {
    line("MPS");
    for (unsigned n = pick(3);; --n) {
      more(1, false);
      if (depth > 0 && pick(4) == 0) branches(depth - 1);
      outputs();
      if (n == 0) break;
      line("MRD");
    }
    line("MPP");
    more(1, false);
    outputs();
  }
  void rung() {
    logic(3);
    if (pick(3) == 0)
      branches(2);
    else
      outputs();
    if (pick(4) == 0) {  // goes on from the result
      more(1, false);
      outputs();
    }
  }

  const std::vector<std::uint16_t>& choices_;
  std::size_t at_ = 0;
  unsigned masters_ = 0;
  std::string text_;
};

RC_GTEST_PROP(LadderRungs, DoWhatTheirTextSays, (const std::vector<std::uint16_t>& choices)) {
  const auto inputs = *rc::gen::container<std::vector<std::uint8_t>>(8, rc::gen::arbitrary<std::uint8_t>());
  const std::string text = Writer(choices).program();
  Program program;
  std::vector<Error> errors;
  if (!compile(text, "rung.il", test_table(), {}, &program, &errors)) RC_FAIL(all_text(errors) + text);
  Engine engine(program);
  Engine looked_at(program);
  DeviceImage image = engine.make_image(), portable = image, watched = image;
  Oracle oracle;
  for (const std::uint8_t input : inputs) {
    for (unsigned i = 0; i < 6; ++i) {
      const std::string name = "X" + std::to_string(i);
      const bool on = (input >> i & 1u) != 0;
      oracle.device[name] = on;
      image.bit[engine.find(name)->index] = portable.bit[engine.find(name)->index] = watched.bit[engine.find(name)->index] = on ? 1 : 0;
    }
    engine.scan(&image);
    RC_ASSERT(engine.fault() == static_cast<unsigned>(kNoFault));
    RC_ASSERT(execute_portable(*program.code(), &portable).fault == static_cast<unsigned>(kNoFault));
    RC_ASSERT(image.bit == portable.bit);
    RC_ASSERT(image.word == portable.word);
    std::vector<std::uint8_t> flow(program.flow_bytes());
    looked_at.scan(&watched, nullptr, 0, flow.data());
    RC_ASSERT(image.bit == watched.bit);
    RC_ASSERT(image.word == watched.word);
    oracle.scan(text);
    std::map<unsigned, bool> power;
    for (const ListedLine& line : program.listing(1, program.line_count(), flow.data()))
      if (line.power != ListedLine::Power::kNone) power[line.line] = line.power == ListedLine::Power::kOn;
    if (power != oracle.power) RC_FAIL("the power flow of\n" + text);
    for (const auto& [name, on] : oracle.device) {
      const bool of_word = name.rfind("D0.", 0) == 0;
      const Device* device = engine.find(of_word ? "D0" : name);
      if (device == nullptr) continue;
      const bool is = of_word ? (image.word[device->index] >> (name.back() - '0') & 1) != 0 : image.bit[device->index] != 0;
      if (is != on) RC_FAIL(name + " in\n" + text);
    }
  }
}

// In long programs the series of cells is divided, and numbered again, at labels and loops.
RC_GTEST_PROP(LadderRungs, DoTheSameBetweenLabels, (const std::vector<std::uint16_t>& choices)) {
  const std::string rungs = Writer(choices).program();
  Rig plain(rungs);
  Rig labelled("P1\n" + rungs + "P2\nFOR K1\nNEXT\nLD SM400\nCJ P3\nLD SM400\nSET Y0\nP3\n");
  Rig called("LD SM400\nCALL P1\nJMP P2\nP2\nFEND\nP1\n" + rungs + "RET\n");
  for (unsigned scan = 0; scan < 6; ++scan) {
    for (unsigned i = 0; i < 6; ++i)
      for (Rig* rig : {&plain, &labelled, &called})
        rig->set("X" + std::to_string(i), static_cast<int>((scan * 7 + 3) >> i & 1u));
    plain.scan();
    labelled.scan();
    called.scan();
    for (unsigned i = 0; i < 6; ++i)
      for (const char* kind : {"Y", "M"}) {
        const std::string name = kind + std::to_string(i);
        RC_ASSERT(plain.get(name) == labelled.get(name));
        RC_ASSERT(plain.get(name) == called.get(name));
      }
    RC_ASSERT(plain.get("D0") == labelled.get("D0"));
    RC_ASSERT(plain.get("D0") == called.get("D0"));
  }
}

}  // namespace
}  // namespace nc::ladder
