// SPDX-License-Identifier: Apache-2.0
// The file of the changes on a disk that is full.
#include "runtime/services/change_log.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace nc::rt::services {
namespace {

Change change(const std::string& what) {
  Change made;
  made.time_ns = 1;
  made.user = "anna";
  made.client = "c";
  made.service = "tools.set";
  made.what = what;
  return made;
}

// A disk that is full: the process may not make a file larger than this. What a write has begun there is no half of a line that swallows the next one.
TEST(ChangeLogFile, AFullDiskLosesOnlyWhatHadNoRoom) {
  char pattern[] = "/tmp/nc-changes-XXXXXX";
  ASSERT_NE(mkdtemp(pattern), nullptr);
  const std::string path = std::string(pattern) + "/changes";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    (void)signal(SIGXFSZ, SIG_IGN);
    rlimit limit{1'000, RLIM_INFINITY};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(1);
    ChangeLog log(path);
    std::string error;
    if (!log.open(&error)) _exit(2);
    unsigned written = 0;
    while (written < 100 && log.add(change("written " + std::to_string(written)), &error)) ++written;
    if (written == 0 || written == 100 || error.empty() || error.find("Success") != std::string::npos) _exit(3);
    if (log.add(change("no room either"), &error)) _exit(4);
    if (log.newest(0, 1)["changes"][0]["what"] != "no room either") _exit(5);  // it is remembered
    limit.rlim_cur = RLIM_INFINITY;
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(6);
    if (!log.add(change("with room again"), &error)) _exit(7);
    ChangeLog again(path);
    if (!again.open(&error)) _exit(8);
    const Json changes = again.newest(0, 500)["changes"];
    if (changes.size() != written + 1 || changes[0]["what"] != "with room again") _exit(9);
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  std::filesystem::remove_all(pattern);
}

}  // namespace
}  // namespace nc::rt::services
