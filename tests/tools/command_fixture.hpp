// SPDX-License-Identifier: Apache-2.0
// Calls ncsim from a shell, as a person does, in a folder of the test.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "own_folder.hpp"
#include "places/places.hpp"

namespace nc::tools {

using Json = nlohmann::json;

struct Outcome {
  int code = -1;
  std::string out, err;
  std::vector<Json> events() const {
    std::vector<Json> list;
    for (size_t at = 0; at < out.size();) {
      const size_t end = out.find('\n', at);
      list.push_back(Json::parse(out.substr(at, end - at)));
      at = end + 1;
    }
    return list;
  }
};

class CommandTest : public OwnFolder {
 protected:
  // `line` is the rest of the command line behind "ncsim ", for the shell; it may redirect standard output.
  Outcome ncsim(const std::string& line) {
    const std::string command =
        "cd " + folder_ + " && { " + nc::test::kBinaryDir + "/bin/ncsim " + line + " ; } > out.txt 2> err.txt";
    const int status =
        std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe,cert-env33-c): a test's own command
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(folder_ + "/out.txt"),
            content(folder_ + "/err.txt")};
  }
};

}  // namespace nc::tools
