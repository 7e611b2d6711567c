// SPDX-License-Identifier: Apache-2.0
// Rows of retained devices. See rows.hpp.
//
//   u32 number of rows; each: u32 length of the name, name, u32 first, u32 count, count x i16
#include "runtime/retain/rows.hpp"

#include <cstring>

namespace nc::rt {
namespace {

constexpr std::uint32_t kMaxRows = 64, kMaxName = 32, kMaxValues = 1u << 17;

void put(std::string* bytes, std::uint32_t value) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}

class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}
  bool number(std::uint32_t most, std::uint32_t* value) { return raw(value, sizeof *value) && *value <= most; }
  bool raw(void* to, std::size_t size) {
    if (bytes_.size() - at_ < size) return false;
    if (size != 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
    return true;
  }
  bool ended() const { return at_ == bytes_.size(); }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

bool decode_row(Reader* reader, RetainedRow* row) {
  std::uint32_t length = 0, count = 0;
  if (!reader->number(kMaxName, &length)) return false;
  row->name.resize(length);
  if (!reader->raw(row->name.data(), length) || !reader->number(~0u, &row->first) ||
      !reader->number(kMaxValues, &count))
    return false;
  row->values.resize(count);
  return reader->raw(row->values.data(), count * sizeof(std::int16_t));
}

}  // namespace

std::string encode_rows(const std::vector<RetainedRow>& rows) {
  std::string bytes;
  put(&bytes, static_cast<std::uint32_t>(rows.size()));
  for (const RetainedRow& row : rows) {
    put(&bytes, static_cast<std::uint32_t>(row.name.size()));
    bytes += row.name;
    put(&bytes, row.first);
    put(&bytes, static_cast<std::uint32_t>(row.values.size()));
    bytes.append(reinterpret_cast<const char*>(row.values.data()), row.values.size() * sizeof(std::int16_t));
  }
  return bytes;
}

bool decode_rows(const std::string& bytes, std::vector<RetainedRow>* rows) {
  rows->clear();
  Reader reader(bytes);
  std::uint32_t count = 0;
  bool good = reader.number(kMaxRows, &count);
  for (std::uint32_t i = 0; good && i < count; ++i) good = decode_row(&reader, &rows->emplace_back());
  if (good && reader.ended()) return true;
  rows->clear();
  return false;
}

}  // namespace nc::rt
