// SPDX-License-Identifier: Apache-2.0
// Feeds every file of the given corpus folders to a fuzz target once, without libFuzzer, so that every compiler tests the
// inputs that fuzzing has found. It calls the same LLVMFuzzerTestOneInput as libFuzzer.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace {

namespace fs = std::filesystem;

bool replay(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) {
    std::fprintf(stderr, "cannot read %s\n", path.c_str());
    return false;
  }
  // A block of exactly this size, so that the address sanitizer sees a read one byte behind the input.
  const auto exact = std::make_unique<uint8_t[]>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), exact.get());
  std::printf("%s (%zu bytes)\n", path.filename().c_str(), bytes.size());
  std::fflush(stdout);  // the last line printed names the input that crashes
  LLVMFuzzerTestOneInput(exact.get(), bytes.size());
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<fs::path> files;
  for (int i = 1; i < argc; ++i) {
    if (!fs::is_directory(argv[i])) {
      std::fprintf(stderr, "no corpus folder %s\n", argv[i]);
      return 1;
    }
    for (const auto& entry : fs::recursive_directory_iterator(argv[i])) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
  }
  if (files.empty()) {
    std::fprintf(stderr, "usage: replay CORPUS_FOLDER... (with at least one file in them)\n");
    return 1;
  }
  std::sort(files.begin(), files.end());
  const auto good = std::count_if(files.begin(), files.end(), replay);
  std::printf("%zu of %zu inputs replayed\n", static_cast<size_t>(good), files.size());
  return static_cast<size_t>(good) == files.size() ? 0 : 1;
}
