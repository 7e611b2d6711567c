// SPDX-License-Identifier: Apache-2.0
// A program of 2 GiB from a client to its place, its check and its start. It takes minutes and 2 GiB of the disk, so it runs where NC_LARGE_PROGRAM says how many MiB.
// And one of more gigabytes, none of which are on the disk.
#include <cstdlib>
#include <fstream>
#include <string>

#include "services/local_machine.hpp"

namespace nc::test {
namespace {

class LargeProgram : public LocalMachine {
 protected:
  std::string check_text() override { return "check = \"warn\"\ncheck_seconds = 2\n"; }
  std::string machine_text() override {
    std::string text = LocalMachine::machine_text();
    for (const char* small : {"program_mb = 4\n", "programs_mb = 8\n"}) text.replace(text.find(small), std::string(small).size(), "");
    return text;
  }
  // Most memory that this process, in which client and control are, has had, in bytes.
  static double most_memory() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
      if (line.rfind("VmHWM:", 0) == 0) return 1024 * std::stod(line.substr(6));
    return -1;
  }
};

TEST_F(LargeProgram, TwoGigabytesAreStreamed) {
  const char* const megabytes = std::getenv("NC_LARGE_PROGRAM");
  if (megabytes == nullptr) GTEST_SKIP() << "NC_LARGE_PROGRAM is not set";
  const std::size_t size = std::stoul(megabytes) << 20;
  std::string piece;
  while (piece.size() < rt::services::kChunkBytes) piece += "G1 X" + std::to_string(piece.size() % 97) + ". F1000.\n";
  piece.resize(piece.rfind('\n', rt::services::kChunkBytes - 1) + 1);
  const std::size_t pieces = size / piece.size() + 1;
  rt::services::Sha256 sum;
  for (std::size_t n = 0; n < pieces; ++n) sum.add(piece);
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("status"), "");
  const double before = most_memory();
  const Json begun = client.call("programs.begin", {{"name", "large.nc"}, {"size", pieces * piece.size()}, {"sha256", sum.finish()}});
  if (begun.value("error", "") == "no space") GTEST_SKIP() << begun["text"];
  ASSERT_EQ(begun["ok"], true) << begun;
  // The requests are put together as texts: to write each of them from a value of JSON would take longer than what is tested.
  const std::string data = rt::services::to_base64(piece), upload = begun["reply"]["upload"].dump();
  for (std::size_t n = 0; n < pieces; ++n) {
    const std::string place = std::to_string(n * piece.size());
    ASSERT_TRUE(client.send_bytes(rt::services::frame_of("{\"id\":1,\"service\":\"programs.data\",\"args\":{\"upload\":" + upload + ",\"begin\":" + place + ",\"data\":\"" + data + "\"}}")));
    ASSERT_EQ(client.receive()["ok"], true) << n;
  }
  ASSERT_EQ(client.outcome("programs.finish", {{"upload", begun["reply"]["upload"]}}), "");
  EXPECT_EQ(std::filesystem::file_size(in_programs("large.nc")), pieces * piece.size());
  EXPECT_LT(most_memory() - before, 100e6) << "the program is never in memory";
  const Json report = until(&client, "programs.check", [](const Json& now) { return now["state"] != "checking"; }, {{"name", "large.nc"}});
  EXPECT_EQ(report["state"], "unchecked");
  EXPECT_NE(report["text"].get<std::string>().find("not checked: too long"), std::string::npos) << report;
  EXPECT_GT(report["blocks"].get<std::uint64_t>(), 1000u);
  EXPECT_LT(most_memory() - before, 200e6) << "nor is it while it is checked";
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "auto"}}), "");
  ASSERT_EQ(client.outcome("select", {{"name", "large.nc"}}), "");
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("start"), "");
  until(&client, "status", [](const Json& now) { return now["systems"][0]["main_line"] > 1; });
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("reset"), "");
  EXPECT_LT(most_memory() - before, 200e6) << "nor while it runs";
  std::printf("%.0f MB more than before, %llu blocks in 2 s\n", (most_memory() - before) / 1e6, static_cast<unsigned long long>(report["blocks"].get<std::uint64_t>()));
}

class VastProgram : public LargeProgram {
 protected:
  std::string check_text() override { return "check = \"off\"\nprogram_mb = 100000\n"; }
};

// The feeder looks for a program inside the text, which takes longer than a reset may. The hold waits for nothing, and the control ends as soon.
TEST_F(VastProgram, AResetDoesNotWaitForASearchInIt) {
  write_program("vast.nc", "O1\nG1 X50. F60.\nM98 P77\n");
  std::filesystem::resize_file(in_programs("vast.nc"), std::uintmax_t{32} << 30);
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "auto"}}), "");
  for (unsigned n = 0; n < 2; ++n) {
    ASSERT_EQ(client.outcome("select", {{"name", "vast.nc"}}), "");
    ASSERT_EQ(client.outcome("start"), "");
    EXPECT_EQ(client.outcome("hold"), "");
    EXPECT_EQ(client.outcome("reset"), "");
    EXPECT_EQ(client.call("alarms")["reply"]["alarms"], Json::array());
  }
  ASSERT_EQ(client.outcome("start"), "");
  runtime_->leave();
}

}  // namespace
}  // namespace nc::test
