// SPDX-License-Identifier: Apache-2.0
#include "ladder/rules.hpp"

#include <map>
#include <string>

namespace nc::ladder {

namespace {

using A = Action;

constexpr const char* kContacts = "Contacts";
constexpr const char* kBlocks = "Blocks and branches";
constexpr const char* kCoils = "Outputs";
constexpr const char* kFlow = "Program flow";
constexpr const char* kCompares = "Compares";
constexpr const char* kMoves = "Moves";
constexpr const char* kSums = "Arithmetic";
constexpr const char* kLogic = "Logic, shifts and bits of words";
constexpr const char* kTables = "Tables and turrets";

void add_contacts(std::vector<Rule>& t) {
  const auto edge = [&](const char* name, const char* summary, A action, Op op, bool parallel) {
    t.push_back({{name, "bit", summary, kContacts, false}, action, op, Op::kNop, "", 0, true, parallel});
  };
  t.push_back(
      {{"LD", "bit", "begins a rung or a block with a contact, on when the device is on", kContacts, false},
       A::kLoad,
       Op::kLd,
       Op::kPushLd});
  t.push_back({{"LDI", "bit", "begins with a contact that is on when the device is off", kContacts, false},
               A::kLoad,
               Op::kLdi,
               Op::kPushLdi});
  t.push_back({{"AND", "bit", "contact in series", kContacts, false}, A::kJoin, Op::kAnd});
  t.push_back({{"ANI", "bit", "contact in series, inverted", kContacts, false}, A::kJoin, Op::kAni});
  t.push_back({{"OR", "bit", "contact in parallel", kContacts, false},
               A::kJoin,
               Op::kOr,
               Op::kNop,
               "",
               0,
               false,
               true});
  t.push_back({{"ORI", "bit", "contact in parallel, inverted", kContacts, false},
               A::kJoin,
               Op::kOri,
               Op::kNop,
               "",
               0,
               false,
               true});
  edge("LDP", "begins with a contact that is on in the scan in which the device turns on", A::kLoad, Op::kLdp,
       false);
  edge("LDF", "begins with a contact that is on in the scan in which the device turns off", A::kLoad,
       Op::kLdf, false);
  edge("ANDP", "rising edge in series", A::kJoin, Op::kAndp, false);
  edge("ANDF", "falling edge in series", A::kJoin, Op::kAndf, false);
  edge("ORP", "rising edge in parallel", A::kJoin, Op::kOrp, true);
  edge("ORF", "falling edge in parallel", A::kJoin, Op::kOrf, true);
}

void add_blocks(std::vector<Rule>& t) {
  const auto plain = [&](const char* name, const char* summary, A action, Op op, bool parallel = false,
                         bool edge = false) {
    t.push_back({{name, "", summary, kBlocks, false}, action, op, Op::kNop, "", 0, edge, parallel});
  };
  plain("ANB", "joins the last two blocks in series", A::kBlock, Op::kAnb);
  plain("ORB", "joins the last two blocks in parallel", A::kBlock, Op::kOrb, true);
  plain("MPS", "keeps the result for the branches that follow", A::kPushBranch, Op::kMps);
  plain("MRD", "goes on from the kept result", A::kReadBranch, Op::kMrd);
  plain("MPP", "goes on from the kept result and forgets it", A::kPopBranch, Op::kMpp);
  plain("INV", "inverts the result", A::kInvert, Op::kInv);
  plain("MEP", "result becomes its rising edge", A::kEdgeOfResult, Op::kMep, false, true);
  plain("MEF", "result becomes its falling edge", A::kEdgeOfResult, Op::kMef, false, true);
}

void add_coils(std::vector<Rule>& t) {
  t.push_back(
      {{"OUT", "bit | T n | ST n | C n",
        "device becomes the result; timer in units of 100 ms; counter counts rising edges", kCoils, false},
       A::kOut,
       Op::kOut,
       Op::kNop,
       "",
       100000});
  t.push_back({{"OUTH", "T n | ST n", "timer in units of 10 ms", kCoils, false},
               A::kOut,
               Op::kNop,
               Op::kNop,
               "",
               10000});
  t.push_back({{"OUTHS", "T n | ST n", "timer in units of 1 ms", kCoils, false},
               A::kOut,
               Op::kNop,
               Op::kNop,
               "",
               1000});
  t.push_back({{"SET", "bit", "device turns on and stays on", kCoils, true}, A::kSet, Op::kSet});
  t.push_back({{"RST", "bit | word | T | ST | C",
                "device turns off or becomes 0; contact and value of a timer or counter", kCoils, true},
               A::kReset,
               Op::kRst});
  t.push_back({{"PLS", "bit", "device is on for the scan in which the result turns on", kCoils, false},
               A::kPulseCoil,
               Op::kPls,
               Op::kNop,
               "",
               0,
               true});
  t.push_back({{"PLF", "bit", "device is on for the scan in which the result turns off", kCoils, false},
               A::kPulseCoil,
               Op::kPlf,
               Op::kNop,
               "",
               0,
               true});
  t.push_back({{"FF", "bit", "device changes over when the result turns on", kCoils, false},
               A::kPulseCoil,
               Op::kFf,
               Op::kNop,
               "",
               0,
               true});
  t.push_back(
      {{"MC", "N bit", "up to MCR of the same N no rung is on while the result is off", kCoils, false},
       A::kMaster,
       Op::kOut});
  t.push_back(
      {{"MCR", "N", "end of the master control N and of those within", kCoils, false}, A::kMasterEnd});
}

void add_flow(std::vector<Rule>& t) {
  t.push_back({{"CJ", "P", "jumps to the label when the result is on", kFlow, true}, A::kJump, Op::kJumpIf});
  t.push_back({{"JMP", "P", "jumps to the label", kFlow, false}, A::kJump, Op::kJump});
  t.push_back({{"CALL", "P", "runs the subroutine at the label when the result is on", kFlow, true},
               A::kCall,
               Op::kCall});
  t.push_back({{"RET", "", "end of a subroutine", kFlow, false}, A::kReturn, Op::kRet});
  t.push_back({{"SRET", "", "the same as RET", kFlow, false}, A::kReturn, Op::kRet});
  t.push_back({{"FOR", "n", "runs the rungs up to NEXT n times; not at all below 1", kFlow, false},
               A::kFor,
               Op::kFor,
               Op::kNop,
               "s"});
  t.push_back({{"NEXT", "", "end of the rungs of FOR", kFlow, false}, A::kNext, Op::kNext});
  t.push_back(
      {{"FEND", "", "end of the main program; subroutines follow", kFlow, false}, A::kMainEnd, Op::kEnd});
  t.push_back({{"END", "", "end of the text; what follows is not read", kFlow, false}, A::kEnd, Op::kEnd});
  t.push_back({{"NOP", "", "nothing", kFlow, false}, A::kNothing});
  t.push_back(
      {{"ALIAS", "name device", "gives a device a second name, from here on", kFlow, false}, A::kAlias});
}

void add_compares(std::vector<Rule>& t) {
  struct Name {
    const char* sign;
    Relation relation;
  };
  static constexpr Name kNames[] = {{"=", Relation::kEqual},   {"<>", Relation::kNotEqual},
                                    {">", Relation::kGreater}, {"<=", Relation::kLessEqual},
                                    {"<", Relation::kLess},    {">=", Relation::kGreaterEqual}};
  struct Join {
    const char* name;
    const char* summary;
    A action;
    Op op, op32;
    bool parallel;
  };
  static constexpr Join kJoins[] = {
      {"LD", "begins with a contact that is on when s1 %s s2", A::kLoad, Op::kLdCompare, Op::kLdCompare32,
       false},
      {"AND", "in series: on when s1 %s s2", A::kJoin, Op::kAndCompare, Op::kAndCompare32, false},
      {"OR", "in parallel: on when s1 %s s2", A::kJoin, Op::kOrCompare, Op::kOrCompare32, true}};
  // The table, which is made only once, holds pointers to these texts.
  static std::vector<std::string> texts;
  texts.reserve(2 * 2 * std::size(kNames) * std::size(kJoins));
  for (const Join& join : kJoins)
    for (const bool wide : {false, true})
      for (const Name& name : kNames) {
        texts.push_back(std::string(join.name) + (wide ? "D" : "") + name.sign);
        const char* mnemonic = texts.back().c_str();
        std::string summary = join.summary;
        summary.replace(summary.find("%s"), 2, name.sign);
        texts.push_back(summary + (wide ? " (32 bits)" : ""));
        t.push_back({{mnemonic, "s1 s2", texts.back().c_str(), kCompares, false},
                     join.action,
                     wide ? join.op32 : join.op,
                     Op::kNop,
                     wide ? "SS" : "ss",
                     static_cast<std::uint32_t>(name.relation),
                     false,
                     join.parallel});
      }
}

void add_words(std::vector<Rule>& t) {
  const auto words = [&](const char* name, const char* operands, const char* summary, const char* group,
                         Op op, const char* spec, A action = A::kWords) {
    t.push_back({{name, operands, summary, group, true}, action, op, Op::kNop, spec});
  };
  words("MOV", "s d", "d becomes s", kMoves, Op::kMov, "sd");
  words("DMOV", "s d", "d becomes s, 32 bits", kMoves, Op::kDmov, "SD");
  words("CML", "s d", "d becomes s with every bit inverted", kMoves, Op::kCml, "sd");
  words("DCML", "s d", "the same, 32 bits", kMoves, Op::kDcml, "SD");
  words("XCH", "d1 d2", "exchanges two words", kMoves, Op::kXch, "dd");
  words("DXCH", "d1 d2", "exchanges two 32-bit words", kMoves, Op::kDxch, "DD");
  words("BMOV", "s d n", "n words from s on go to d on; the rows may overlap", kMoves, Op::kBmov, "rws");
  words("FMOV", "s d n", "n words from d on become s", kMoves, Op::kFmov, "sws");
  words("BCD", "s d", "binary 0 to 9999 to four BCD digits", kMoves, Op::kBcd, "sd");
  words("DBCD", "s d", "binary 0 to 99999999 to eight BCD digits", kMoves, Op::kDbcd, "SD");
  words("BIN", "s d", "four BCD digits to binary", kMoves, Op::kBin, "sd");
  words("DBIN", "s d", "eight BCD digits to binary", kMoves, Op::kDbin, "SD");

  words("+", "s d | s1 s2 d", "d becomes d + s, or s1 + s2; wraps", kSums, Op::kAdd, "ssd", A::kAccumulate);
  words("-", "s d | s1 s2 d", "d becomes d - s, or s1 - s2; wraps", kSums, Op::kSub, "ssd", A::kAccumulate);
  words("D+", "s d | s1 s2 d", "sum of 32-bit words; wraps", kSums, Op::kDadd, "SSD", A::kAccumulate);
  words("D-", "s d | s1 s2 d", "difference of 32-bit words; wraps", kSums, Op::kDsub, "SSD", A::kAccumulate);
  words("*", "s1 s2 d", "32-bit d becomes s1 * s2", kSums, Op::kMul, "ssD");
  words("/", "s1 s2 d", "d becomes s1 / s2, the word behind it the remainder", kSums, Op::kDiv, "ssq");
  words("D*", "s1 s2 d", "64 bits from d on become s1 * s2", kSums, Op::kDmul, "SSQ");
  words("D/", "s1 s2 d", "32-bit d becomes s1 / s2, the 32 bits behind it the remainder", kSums, Op::kDdiv,
        "SSQ");
  words("INC", "d", "d becomes d + 1; wraps", kSums, Op::kInc, "d");
  words("DINC", "d", "the same, 32 bits", kSums, Op::kDinc, "D");
  words("DEC", "d", "d becomes d - 1; wraps", kSums, Op::kDec, "d");
  words("DDEC", "d", "the same, 32 bits", kSums, Op::kDdec, "D");
  words("NEG", "d", "d changes its sign", kSums, Op::kNeg, "d");
  words("DNEG", "d", "the same, 32 bits", kSums, Op::kDneg, "D");

  words("WAND", "s d | s1 s2 d", "AND bit by bit", kLogic, Op::kWand, "ssd", A::kAccumulate);
  words("WOR", "s d | s1 s2 d", "OR bit by bit", kLogic, Op::kWor, "ssd", A::kAccumulate);
  words("WXOR", "s d | s1 s2 d", "exclusive OR bit by bit", kLogic, Op::kWxor, "ssd", A::kAccumulate);
  words("DAND", "s d | s1 s2 d", "AND, 32 bits", kLogic, Op::kDwand, "SSD", A::kAccumulate);
  words("DOR", "s d | s1 s2 d", "OR, 32 bits", kLogic, Op::kDwor, "SSD", A::kAccumulate);
  words("DXOR", "s d | s1 s2 d", "exclusive OR, 32 bits", kLogic, Op::kDwxor, "SSD", A::kAccumulate);
  words("ROR", "d n", "turns d right by n bits; SM700 is the last bit that went round", kLogic, Op::kRor,
        "ds");
  words("ROL", "d n", "turns d left by n bits; SM700 is the last bit that went round", kLogic, Op::kRol,
        "ds");
  words("DROR", "d n", "ROR, 32 bits", kLogic, Op::kDror, "Ds");
  words("DROL", "d n", "ROL, 32 bits", kLogic, Op::kDrol, "Ds");
  words("SFR", "d n", "shifts d right by n (0 to 15), zeros follow; SM700 is the last bit out", kLogic,
        Op::kSfr, "ds");
  words("SFL", "d n", "shifts d left by n (0 to 15), zeros follow; SM700 is the last bit out", kLogic,
        Op::kSfl, "ds");
  words("BSET", "d n", "bit n (0 to 15) of d turns on", kLogic, Op::kBset, "ds");
  words("BRST", "d n", "bit n (0 to 15) of d turns off", kLogic, Op::kBrst, "ds");
  words("ZRST", "first last", "resets a row of M, L, T, ST, C, D or Z", kLogic, Op::kZrstBits, "",
        A::kResetRange);

  words("SER", "s1 s2 d n",
        "looks for s1 in n words from s2 on: d is the place of the first (1 to n, 0 = none), the word "
        "behind it how many there are",
        kTables, Op::kSer, "srqs");
  words("DSER", "s1 s2 d n", "SER in n 32-bit words", kTables, Op::kDser, "SrQs");
  words("ROTS", "s1 s2 s3 d",
        "turret or magazine of s1 places (1 to s1): d is the shortest way from place s2 to place "
        "s3 in places, positive upwards; half way round is positive",
        kTables, Op::kRots, "sssd");
}

}  // namespace

const std::vector<Rule>& rules() {
  static const std::vector<Rule> table = [] {
    std::vector<Rule> t;
    add_contacts(t);
    add_blocks(t);
    add_coils(t);
    add_compares(t);
    add_words(t);
    add_flow(t);
    return t;
  }();
  return table;
}

const std::vector<InstructionInfo>& instruction_table() {
  static const std::vector<InstructionInfo> table = [] {
    std::vector<InstructionInfo> t;
    for (const Rule& rule : rules()) t.push_back(rule.info);
    return t;
  }();
  return table;
}

const Rule* find_rule(std::string_view mnemonic, bool* pulse) {
  static const std::map<std::string_view, const Rule*> by_name = [] {
    std::map<std::string_view, const Rule*> names;
    for (const Rule& rule : rules()) names.emplace(rule.info.name, &rule);
    return names;
  }();
  *pulse = false;
  auto found = by_name.find(mnemonic);
  if (found != by_name.end()) return found->second;
  if (mnemonic.size() < 2 || mnemonic.back() != 'P') return nullptr;
  found = by_name.find(mnemonic.substr(0, mnemonic.size() - 1));
  if (found == by_name.end() || !found->second->info.pulse) return nullptr;
  *pulse = true;
  return found->second;
}

}  // namespace nc::ladder
