// SPDX-License-Identifier: Apache-2.0
// The folders from which tests read files and start programs. They are variables of one source file and not options of the compiler, so that
// the objects of all other tests are the same in every checkout, and a compiler cache can share them.
#pragma once

#include <string>

namespace nc::test {

extern const std::string kSourceDir;  // the root of the checkout
extern const std::string kBinaryDir;  // the build tree; programs are in bin/
extern const std::string kSharedDir;  // the shared cases and programs; most users do not have them, then skip the test

}  // namespace nc::test
