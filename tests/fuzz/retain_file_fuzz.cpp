// SPDX-License-Identifier: Apache-2.0
// Any bytes as the files of retained data: the last one, the one that is being written, the one before. The newest complete file with a right check
// sum is loaded; a loss is reported; loading changes nothing; and what is saved afterwards is loaded again.
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "fuzz/input.hpp"
#include "runtime/retain/store.hpp"

namespace {

using namespace nc::fuzz;
using nc::rt::RetainStore;

constexpr const char* kEndings[] = {"", ".new", ".old"};
constexpr std::size_t kHeader = 32, kChecked = 16;  // magic, version, check | generation, length

/// A folder of this process, which is removed together with the files that a store makes.
struct Folder {
  std::string path = "/tmp/retain_fuzz_XXXXXX";
  Folder() { require(mkdtemp(path.data()) != nullptr); }
  ~Folder() {
    for (const char* ending : {"", ".new", ".old", ".damaged", ".lock"}) unlink((file() + ending).c_str());
    rmdir(path.c_str());
  }
  std::string file() const { return path + "/kept"; }
};

std::uint32_t crc32(const std::string& bytes) {  // IEEE 802.3, bit by bit: not the table of the store
  std::uint32_t crc = ~0u;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (unsigned bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (0xEDB88320u & (0u - (crc & 1)));
  }
  return ~crc;
}

template <class T>
void put(std::string* bytes, T value) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A complete file, with damages that the input chooses.
std::string file_from(Bytes* in) {
  const std::uint8_t shape = in->byte();
  const std::uint64_t generation = (shape & 1) != 0 ? in->value<std::uint64_t>() : in->byte();
  const std::string payload = in->text(in->byte());
  std::string checked;
  put(&checked, generation);
  put(&checked, (shape & 2) != 0 ? in->value<std::uint64_t>() : std::uint64_t{payload.size()});
  checked += payload;
  std::string bytes = "ncretain";
  put(&bytes, (shape & 4) != 0 ? in->value<std::uint32_t>() : 1u);
  put(&bytes, crc32(checked));
  bytes += checked;
  if ((shape & 8) != 0) bytes[in->value<std::uint16_t>() % bytes.size()] ^= static_cast<char>(in->byte());
  if ((shape & 16) != 0) bytes.resize(in->byte() % (bytes.size() + 1));
  return bytes;
}

std::uint64_t generation_of(const std::string& bytes) {
  std::uint64_t generation = 0;
  std::memcpy(&generation, bytes.data() + kChecked, sizeof generation);
  return generation;
}

bool is_whole(const std::string& bytes) {
  if (bytes.size() < kHeader || bytes.compare(0, 8, "ncretain") != 0) return false;
  std::string expected = "ncretain";
  put(&expected, 1u);
  put(&expected, crc32(bytes.substr(kChecked)));
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data() + kChecked + 8, sizeof length);
  return bytes.compare(0, kChecked, expected) == 0 && length == bytes.size() - kHeader && generation_of(bytes) != ~std::uint64_t{0};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  Bytes in(data, size);
  const std::uint8_t there = in.byte();
  std::string file[3];
  const std::string* newest = nullptr;
  for (unsigned i = 0; i < 3; ++i) {
    const std::string name = folder.file() + kEndings[i];
    unlink(name.c_str());
    if ((there >> i & 1) == 0) continue;
    file[i] = file_from(&in);
    std::ofstream(name, std::ios::binary) << file[i];
    if (is_whole(file[i]) && (newest == nullptr || generation_of(file[i]) > generation_of(*newest))) newest = &file[i];
  }
  RetainStore store(folder.file()), again(folder.file());
  std::string payload = "untouched", error;
  const RetainStore::Loaded loaded = store.load(&payload, &error);
  if (newest == nullptr) {
    require(payload == "untouched" && loaded == ((there & 5) != 0 ? RetainStore::Loaded::kDamaged : RetainStore::Loaded::kNothing));
  } else {
    require(loaded == RetainStore::Loaded::kWhole || loaded == RetainStore::Loaded::kOlder);
    require(payload == newest->substr(kHeader) && store.generation() == generation_of(*newest));
  }
  if (loaded == RetainStore::Loaded::kOlder || loaded == RetainStore::Loaded::kDamaged) require(!error.empty());
  std::string same = "untouched", second;
  require(again.load(&same, &second) == loaded && same == payload && second == error);
  // A save to a disk takes long, so only some inputs go on.
  if ((there & 0xF8) != 0xF8) return 0;
  require(store.save("the next one", &error));
  RetainStore next(folder.file());
  require(next.load(&payload, &error) == RetainStore::Loaded::kWhole && payload == "the next one");
  return 0;
}
