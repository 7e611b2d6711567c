// SPDX-License-Identifier: Apache-2.0
#include "places/places.hpp"

namespace nc::test {

const std::string kSourceDir = NC_SOURCE_DIR;
const std::string kBinaryDir = NC_BINARY_DIR;
const std::string kSharedDir = NC_SHARED_DIR;

}  // namespace nc::test
