// SPDX-License-Identifier: Apache-2.0
// The folders that the tests read and start programs from. They are names of one source file and no options of the compiler, so that
// the objects of all other tests are the same in every checkout and a compiler cache can share them.
#pragma once

#include <string>

namespace nc::test {

extern const std::string kSourceDir;  // the root of the checkout
extern const std::string kBinaryDir;  // the build tree; programs are in bin/
extern const std::string kSharedDir;  // the shared cases and programs; absent for most users: skip then

}  // namespace nc::test
