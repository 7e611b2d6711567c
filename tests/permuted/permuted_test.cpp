// SPDX-License-Identifier: Apache-2.0
// Proves that the numbers of a family are in its tables and nowhere else: a family that is m700 with every G code, modal
// group, parameter number and range of system variables permuted gives the same trace for every program that is rewritten
// in the same way.
//
// Letters of words are permuted, too, except those of axes, codes, block numbers, E (an exponent for the lexer), F, S and T.
//
// M codes, the L of data input, O numbers, local and common variables, and parameters with a name are not permuted. Names
// of the setup format that are those of m700 (work_offsets) stay as they are.
//
// A trace is the same when its lines are the same, with two exceptions: the modal codes of its end are permuted back and
// have the order of the groups; and the codes, variables and parameters in the sentence of an alarm must be the permuted
// ones.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "dialect/function_table.hpp"
#include "dialect/m700/m700.hpp"
#include "places/places.hpp"
#include "rewrite.hpp"
#include "support/seeds.hpp"
#include "tools/lib/commands.hpp"

namespace nc::permuted {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Program {
  std::string id, text;
  Json setup = Json::object();
};

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

bool has_shared() { return fs::is_directory(nc::test::kSharedDir + "/conformance") && fs::is_directory(nc::test::kSharedDir + "/programs"); }

void add_conformance(std::vector<Program>* programs) {
  for (const fs::path& path : files_in(nc::test::kSharedDir + "/conformance")) {
    if (path.extension() != ".json") continue;
    const Json file = Json::parse(content_of(path));
    for (const Json& one : file["cases"])
      if (one["dialect"] == "m700") programs->push_back({one["id"], one["program"], one.value("setup", Json::object())});
  }
}

// Words without a point mean whole units in these programs.
void add_shop_programs(std::vector<Program>* programs) {
  for (const fs::path& path : files_in(nc::test::kSharedDir + "/programs"))
    if (path.extension() != ".md") programs->push_back({path.filename(), content_of(path), {{"params", {{"1078", 1}}}}});
}

void add_parts(std::vector<Program>* programs) {
  const fs::path folder = nc::test::kSourceDir + "/examples/parts";
  for (const char* name : {"bolt-circle", "flange", "tool-length"}) {
    Program program{std::string(name) + ".nc", content_of(folder / (std::string(name) + ".nc"))};
    if (fs::path setup = folder / (std::string(name) + ".json"); fs::exists(setup)) program.setup = Json::parse(content_of(setup));
    programs->push_back(program);
  }
}

// The corpus of the fuzz program: two bytes of choices (the lowest bit of the first is the family), then the text. The
// codes that call a program are those of the fuzz program.
void add_corpus(std::vector<Program>* programs) {
  const Json params = {{"7001", 50}, {"7003", 8}, {"7201", 120}, {"7202", 3}, {"7203", 7}, {"7401", 1},
                       {"7402", "D"}, {"7403", 0}, {"7404", 7}, {"7405", 130}, {"2106", {{"A", 5}}}};
  const Json axes = {"X", "Y", "Z", {{"name", "A"}, {"rotary", true}}};
  for (const fs::path& path : files_in(nc::test::kSourceDir + "/tests/fuzz/corpus/program")) {
    const std::string bytes = content_of(path);
    if (bytes.size() < 3 || (bytes[0] & 1) != 0 || path.filename().string().rfind("dgshape", 0) == 0) continue;
    programs->push_back({"corpus/" + path.filename().string(), bytes.substr(2), {{"axes", axes}, {"params", params}}});
  }
}

std::vector<Program> all_programs() {
  std::vector<Program> programs;
  add_conformance(&programs);
  add_shop_programs(&programs);
  add_parts(&programs);
  add_corpus(&programs);
  return programs;
}

/// Traces programs in its own folder.
class Tracer {
 public:
  Tracer() {
    std::string pattern = (fs::temp_directory_path() / "nc-permuted-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    err_ = std::fopen((folder_ / "err").c_str(), "w+");
    out_ = std::fopen((folder_ / "out").c_str(), "w+");
  }
  ~Tracer() {
    std::fclose(err_);
    std::fclose(out_);
    fs::remove_all(folder_);
  }
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  struct Trace {
    int status = 0;
    std::vector<std::string> lines;
    std::string refused;  ///< why it did not run
  };
  /// A file must be unchanged for a moment before it is read (runtime/programs/program_text.hpp), which would be most of the time of these tests. So
  /// all files are written first.
  void write(const Program& program) {
    file_of(program.text);
    file_of(program.setup.dump());
  }
  Trace trace(const Dialect& family, const Program& program) {
    tools::RunLimits limits;
    limits.silent_blocks = 20'000;
    choose(family);
    tools::SessionOptions options;
    options.program = file_of(program.text);
    options.setup = file_of(program.setup.dump());
    for (std::FILE* file : {out_, err_}) {
      std::rewind(file);
      EXPECT_EQ(ftruncate(fileno(file), 0), 0);
    }
    Trace result;
    result.status = tools::trace_command(options, limits, fileno(out_), err_);
    std::fflush(err_);
    choose(m700::kDialect);
    result.refused = content_of(folder_ / "err");
    std::ifstream lines(folder_ / "out");
    for (std::string line; std::getline(lines, line);) result.lines.push_back(line);
    return result;
  }

 private:
  /// The file with this text, which is written at the first call.
  std::string file_of(const std::string& text) {
    const auto [found, fresh] = files_.try_emplace(text, (folder_ / ("file" + std::to_string(files_.size()))).string());
    if (fresh) std::ofstream(found->second, std::ios::binary) << text;
    return found->second;
  }

  std::map<std::string, std::string> files_;  ///< by their texts
  fs::path folder_;
  std::FILE *out_ = nullptr, *err_ = nullptr;
};

class Compare {
 public:
  explicit Compare(const Permutation& permutation) : permutation_(permutation) {}

  /// "" when the traces are the same, else the first lines that differ.
  std::string difference(const Tracer::Trace& want, const Tracer::Trace& got) const {
    if (want.status != got.status)
      return "status " + std::to_string(want.status) + ", permuted " + std::to_string(got.status) + " " + got.refused;
    for (size_t i = 0; i < want.lines.size() || i < got.lines.size(); ++i) {
      const std::string a = i < want.lines.size() ? want.lines[i] : "", b = i < got.lines.size() ? got.lines[i] : "";
      if (a != b && (a.empty() || b.empty() || !same_line(a, b))) return "\n    m700     " + a + "\n    permuted " + b;
    }
    return "";
  }

 private:
  bool same_line(const std::string& want, const std::string& got) const {
    Json a = Json::parse(want), b = Json::parse(got);
    if (a["t"] != b["t"]) return false;
    if (a["t"] == "end") {
      for (Json& code : b["modal"]) code = code_back(code);
      std::sort(a["modal"].begin(), a["modal"].end());
      std::sort(b["modal"].begin(), b["modal"].end());
    } else if (a["t"] == "alarm") {
      if (!same_sentence(a["detail"], b["detail"])) return false;
      b["detail"] = a["detail"];
    }
    return a == b;
  }

  std::string code_back(const std::string& text) const {
    char back[8];
    const int code = static_cast<int>(std::lround(std::atof(text.c_str() + 1) * 10));
    g_code_text('G', permutation_.code_back(code), back, sizeof back);
    return back;
  }

  // A number behind '#' or in data that is read is a variable or a parameter; P is a parameter where parameters are set.
  bool same_sentence(const std::string& want, const std::string& got) const {
    // Letters of words are permuted, too, so all of them count as the same.
    static const std::regex kLetter(R"(\b[PQRLDHIJK](?=[-+0-9.,:;) ]|$))");
    return same_numbers(std::regex_replace(want, kLetter, "P"), std::regex_replace(got, kLetter, "P"));
  }
  bool same_numbers(const std::string& want, const std::string& got) const {
    static const std::regex kNamed(R"(([GP#]|variable |device )([0-9]+(\.[0-9])?))");
    std::sregex_iterator a(want.begin(), want.end(), kNamed), b(got.begin(), got.end(), kNamed), end;
    for (; a != end && b != end; ++a, ++b)
      if (!same_name(*a, *b)) return false;
    return a == end && b == end && std::regex_replace(want, kNamed, "_") == std::regex_replace(got, kNamed, "_");
  }
  bool same_name(const std::smatch& want, const std::smatch& got) const {
    if (want[1] != got[1]) return false;
    if (want[1] == "G") return code_back(got.str()) == want.str();
    const auto number = static_cast<uint32_t>(std::stoul(want[2]));
    if (want[1] == "P" && want.str() == got.str()) return true;
    return (want[1] != "P" && got[2] == std::to_string(permutation_.variable(number))) ||
           got[2] == std::to_string(permutation_.parameter(number));
  }

  const Permutation& permutation_;
};

/// Programs that are not compared, with the reason: lines `id  # reason`.
std::map<std::string, std::string> excluded() {
  std::map<std::string, std::string> list;
  std::ifstream file(nc::test::kSourceDir + "/tests/permuted/excluded.txt");
  for (std::string line; std::getline(file, line);) {
    const size_t hash = line.find('#');
    std::string id = line.substr(0, hash);
    while (!id.empty() && id.back() == ' ') id.pop_back();
    if (!id.empty()) list[id] = hash == std::string::npos ? "" : line.substr(hash + 1);
  }
  return list;
}

Program permuted_program(const Program& program, const Permutation& permutation) {
  return {program.id, rewritten(program.text, m700::kDialect, permutation), rewritten(program.setup, m700::kDialect, permutation)};
}

TEST(Permuted, ProgramsGiveTheTraceOfTheFamilyWhoseNumbersWereMoved) {
  if (!has_shared()) GTEST_SKIP() << nc::test::kSharedDir << " is not here";
  const Permutation permutation(m700::kDialect);
  const PermutedDialect permuted(m700::kDialect, permutation);
  const Compare compare(permutation);
  const std::map<std::string, std::string> list = excluded();
  std::set<std::string> missing;
  for (const auto& [id, reason] : list) {
    EXPECT_FALSE(reason.empty()) << id << " is excluded without a reason";
    missing.insert(id);
  }
  Tracer tracer;
  unsigned same = 0, refused = 0, left_out = 0, not_rewritten = 0;
  const std::vector<Program> programs = all_programs();
  for (const Program& program : programs) {
    tracer.write(program);
    tracer.write(permuted_program(program, permutation));
  }
  for (const Program& program : programs) {
    const Tracer::Trace want = tracer.trace(m700::kDialect, program);
    const Tracer::Trace got = tracer.trace(permuted.dialect(), permuted_program(program, permutation));
    const std::string difference = compare.difference(want, got);
    refused += want.lines.empty();
    if (list.count(program.id) != 0) {
      missing.erase(program.id);
      ++left_out;
      EXPECT_NE(difference, "") << program.id << " is excluded and gives the same trace";
      continue;
    }
    EXPECT_EQ(difference, "") << program.id << "\n" << permuted_program(program, permutation).text.substr(0, 600);
    same += difference.empty();
    // The original text must mean something else to the permuted family, or the comparison would show nothing.
    not_rewritten += !compare.difference(want, tracer.trace(permuted.dialect(), program)).empty();
  }
  for (const std::string& id : missing) ADD_FAILURE() << id << " is excluded and is no program here";
  EXPECT_LE(left_out * 50, programs.size()) << "more than 2 % are excluded";
  std::printf("%u of %zu programs compared and the same, %u excluded, %u refused before their first block; "
      "%u differ when not rewritten\n",
      same, programs.size(), left_out, refused, not_rewritten);
  EXPECT_GT(not_rewritten * 10, same * 9);
}

// Programs that compute numbers of parameters and system variables, set parameters, read modal data and call programs by codes.
TEST(Permuted, ProgramsThatComputeNumbersRunToTheirEnd) {
  const Permutation permutation(m700::kDialect);
  const PermutedDialect permuted(m700::kDialect, permutation);
  const Compare compare(permutation);
  Tracer tracer;
  unsigned programs = 0;
  for (const fs::path& path : files_in(nc::test::kSourceDir + "/tests/permuted/programs")) {
    if (path.extension() != ".nc") continue;
    Program program{path.filename(), content_of(path)};
    if (fs::path setup = path; fs::exists(setup.replace_extension(".json"))) program.setup = Json::parse(content_of(setup));
    const Tracer::Trace want = tracer.trace(m700::kDialect, program);
    ASSERT_FALSE(want.lines.empty()) << program.id << want.refused;
    EXPECT_NE(want.lines.back().find("\"ok\":true"), std::string::npos) << program.id << " " << want.lines.back();
    EXPECT_EQ(compare.difference(want, tracer.trace(permuted.dialect(), permuted_program(program, permutation))), "") << program.id;
    EXPECT_NE(compare.difference(want, tracer.trace(permuted.dialect(), program)), "") << program.id << " is the same when not rewritten";
    ++programs;
  }
  EXPECT_GE(programs, 4u);
}

// Programs use only some of the codes and numbers; these use each row of the tables once.
std::vector<Program> probes_of_codes(const Dialect& family) {
  std::vector<Program> probes;
  for (const FunctionRow& row : family.functions) {
    char code[8];
    g_code_text('G', row.code, code, sizeof code);
    const std::string g = code;
    probes.push_back({g + " with axes", "G90 F100.\n" + g + " X1. Y2. F200.\nX3. Y1.\n#500=#5001\nM30\n"});
    probes.push_back({g + " alone", "G90 F100.\n" + g + "\nX3. Y1.\nG3 X5. R4.\nM30\n"});
    probes.push_back({g + " with P1", "G90 F100.\nX5.\n" + g + " P1 R2. Z-1.\nX3. Y1.\nM30\n"});
  }
  return probes;
}

bool is_by_group(const VariableRow& row) {
  return row.what == SystemVariable::code || row.what == SystemVariable::code_now || row.what == SystemVariable::code_at_interrupt;
}

std::vector<Program> probes_of_variables(const Dialect& family) {
  std::vector<Program> probes;
  for (const VariableRow& row : family.variables->rows) {
    if (is_by_group(row)) continue;  // their values are codes: ModalCodesAreRead
    for (const uint32_t number : {row.first, (row.first + row.last) / 2, row.last}) {
      const std::string name = "#" + std::to_string(number);
      probes.push_back({name + " read", "G90 G54 G0 X3. Y4. Z5.\n#500=" + name + "\nM30\n"});
      probes.push_back({name + " written", name + "=1\n#500=" + name + "\nG90 G54 G43 H1 G0 X3. Y4. Z5.\nM30\n"});
    }
  }
  return probes;
}

std::vector<Program> probes_of_parameters(const Dialect& family) {
  const std::string text =
      "G0 X1. Y1.\nG1 X10 Y5. F3\nG2 X20. Y5. I5.\nG83 Z-5. R1. Q2. F100.\nG80\nG4 X1.5\n"
      "G41 D1 X30.\nY40.\nG40\nG120\nM50\n";
  std::vector<Program> probes;
  for (const ParameterRow& row : family.parameters->numbers) {
    for (uint32_t number = row.first; number <= row.last; number += row.step) {
      const std::string key = std::to_string(number), read = "#100000=" + key + "\n#500=#100010\nM30\n";
      const std::string of_bit = row.bit < 0 ? "" : "/bit" + std::to_string(row.bit);
      for (const int value : {1, 3})
        probes.push_back({key + of_bit + " = " + std::to_string(value), text + read, {{"params", {{key + of_bit, value}}}}});
      probes.push_back({key + " by program", "G10 L70\nP" + key + " D1.\nG11\n" + read});
    }
  }
  return probes;
}

TEST(Permuted, EveryRowOfTheTablesMeansTheSameUnderItsNewNumber) {
  const Dialect& family = m700::kDialect;
  const Permutation permutation(family);
  const PermutedDialect permuted(family, permutation);
  const Compare compare(permutation);
  Tracer tracer;
  for (const std::vector<Program>& probes : {probes_of_codes(family), probes_of_variables(family), probes_of_parameters(family)}) {
    unsigned refused = 0, compared = 0;
    const size_t step = nc::test::sanitized() ? 20 : 1;
    for (size_t n = 0; n < probes.size(); n += step) {
      tracer.write(probes[n]);
      tracer.write(permuted_program(probes[n], permutation));
    }
    for (size_t n = 0; n < probes.size(); n += step, ++compared) {
      const Program& program = probes[n];
      const Tracer::Trace want = tracer.trace(family, program);
      refused += want.lines.empty();
      EXPECT_EQ(compare.difference(want, tracer.trace(permuted.dialect(), permuted_program(program, permutation))), "") << program.id;
    }
    std::printf("%u probes compared, %u of them with a setup that the control refuses\n", compared, refused);
    EXPECT_LT(refused * 2, compared);
  }
}

TEST(Permuted, ModalCodesAreRead) {
  const Dialect& family = m700::kDialect;
  const Permutation permutation(family);
  const PermutedDialect permuted(family, permutation);
  Tracer tracer;
  unsigned read = 0;
  const auto reads = [](uint32_t number) { return Program{"", "G91 G55 G61 G18 G0 G99 G20\n#500=#" + std::to_string(number) + "\nM30\n"}; };
  for (const VariableRow& row : family.variables->rows) {
    for (uint32_t number = row.first; is_by_group(row) && number <= row.last; ++number) {
      tracer.write(reads(number));
      tracer.write(permuted_program(reads(number), permutation));
    }
  }
  for (const VariableRow& row : family.variables->rows) {
    for (uint32_t number = row.first; is_by_group(row) && number <= row.last; ++number) {
      const Program program = reads(number);
      const Tracer::Trace want = tracer.trace(family, program);
      const Tracer::Trace got = tracer.trace(permuted.dialect(), permuted_program(program, permutation));
      const Json a = Json::parse(want.lines.back())["vars"], b = Json::parse(got.lines.back())["vars"];
      ASSERT_EQ(a.contains("500"), b.contains("500")) << number;
      if (!a.contains("500") || a["500"].is_null()) continue;
      const double code = a["500"], moved = b["500"];
      EXPECT_EQ(permutation.code(static_cast<int>(std::lround(code * 10))), std::lround(moved * 10)) << number;
      ++read;
    }
  }
  EXPECT_GE(read, 40u);
}

TEST(Permuted, NoNumberStaysWhereItIs) {
  const Dialect& family = m700::kDialect;
  const Permutation permutation(family);
  std::set<int> codes;
  for (const FunctionRow& row : family.functions) {
    EXPECT_NE(permutation.code(row.code), row.code);
    EXPECT_EQ(permutation.code_back(permutation.code(row.code)), row.code);
    codes.insert(permutation.code(row.code));
    if (row.group != 0) {
      EXPECT_NE(permutation.group(row.group), row.group);
    }
  }
  EXPECT_EQ(codes.size(), family.functions.size);
  for (const ParameterRow& row : family.parameters->numbers) EXPECT_NE(permutation.parameter(row.first), row.first);
  for (const VariableRow& row : family.variables->rows) EXPECT_NE(permutation.variable(row.first), row.first);
  std::set<uint32_t> parameters, variables;
  for (uint32_t n = 1; n < 200'000; ++n) {
    parameters.insert(permutation.parameter(n));
    variables.insert(permutation.variable(n));
  }
  EXPECT_EQ(parameters.size(), 199'999u);
  EXPECT_EQ(variables.size(), 199'999u);
  EXPECT_EQ(*variables.rbegin(), 199'999u);
}

TEST(Permuted, TextsAreRewrittenWhereTheyNameNumbers) {
  const Dialect& family = m700::kDialect;
  const Permutation p(family);
  const auto text = [&](const std::string& from) { return rewritten(from, family, p); };
  const auto g = [&](int code) {
    char out[8];
    g_code_text('G', p.code(code), out, sizeof out);
    return std::string(out);
  };
  const auto moved = [&](const std::string& letters) {
    std::string out;
    for (const char c : letters) out += Permutation::letter(c);
    return out;
  };
  const auto v = [&](uint32_t number) { return std::to_string(p.variable(number)); };
  EXPECT_EQ(text("N1 G1X2(G1)g54.1 P1 G"), "N1 " + g(10) + "X2(G1)g" + g(541).substr(1) + " Q1 " + g(0));
  EXPECT_EQ(text("IF[#1GT5]GOTO10 G65<G1>#100=#5001"), "IF[#1GT5]GOTO10 " + g(650) + "<G1>#100=#" + v(5001));
  EXPECT_EQ(text("#[#1+1364]=#[2]"), "#[#1+" + v(1364) + "]=#[2]");
  EXPECT_EQ(text("#[10000+#1]=1000"), "#[" + std::to_string(p.variable(10001) - 1) + "+#1]=1000");
  EXPECT_EQ(text("#100000=8204\n#100=8204"), "#" + v(100000) + "=" + std::to_string(p.parameter(8204)) + "\n#100=8204");
  EXPECT_EQ(text("G10L70\nP8206D1\nG11\nP8206"), g(100) + "P70\nQ" + std::to_string(p.parameter(8206)) + "H1\n" + g(110) + "\nQ8206");
  EXPECT_EQ(text("WHILE[#1LT2]DO1\nEND1\n#1=EXP[2]+ROUND[#2]\nX1 I2,R-3 k#4"), "WHILE[#1LT2]DO1\nEND1\n#1=EXP[2]+ROUND[#2]\nX1 " + moved("I") + "2," + moved("R") + "-3 i#4");
}

}  // namespace
}  // namespace nc::permuted
