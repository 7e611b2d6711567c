// SPDX-License-Identifier: Apache-2.0
// See service_caller.hpp.
#include "dds/service_caller.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "runtime/clock.hpp"
#include "runtime/share/text.hpp"

namespace nc::dds {
namespace {

constexpr std::int64_t kMs = 1'000'000, kSecond = 1000 * kMs;
constexpr std::int64_t kFindNs = 10'000 * kMs;      // for a gateway to be found, or one that takes over from another
constexpr std::int64_t kPatienceNs = 30'000 * kMs;  // for a reply
constexpr int kTaken = 16;

std::int64_t now() {
  return rt::RealClock().now_ns();
}

Topic topic_for(rt::services::Right right) {
  return static_cast<Topic>(static_cast<unsigned>(Topic::kServiceView) + static_cast<unsigned>(right));
}

template <std::size_t kSize>
bool put(const std::string& from, char (&to)[kSize]) {
  if (from.size() >= kSize) return false;
  from.copy(to, from.size());
  to[from.size()] = '\0';
  return true;
}

}  // namespace

ServiceCaller::Result ServiceCaller::open(const Access& access, const std::string& control, const std::string& client, std::string* error) {
  access_ = access;
  control_ = control;
  client_ = client;
  if (!access.security.empty()) {
    if (!read_identity(access.security, &identity_.emplace(), error)) return Result::kNobody;
  }
  if (!participant_.open(access, error)) return Result::kNobody;
  replies_ = make_reader(participant_.get(), Topic::kServiceReply, control + "/" + client, error);
  if (replies_ <= 0) return replies_ == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY ? Result::kNotAllowed : Result::kNobody;
  waitset_ = dds_create_waitset(participant_.get());
  const dds_entity_t condition = dds_create_readcondition(replies_, DDS_ANY_STATE);
  if (waitset_ > 0 && condition > 0 && dds_waitset_attach(waitset_, condition, 0) >= 0) return Result::kDone;
  *error = "the replies cannot be waited for";
  return Result::kNobody;
}

// From the end of its certificate on a participant is heard by nobody, and waits in vain.
bool ServiceCaller::has_expired(std::string* error) const {
  const std::int64_t now_s = rt::share::wall_ns() / kSecond;
  if (!identity_ || validity_of(*identity_, now_s) != Validity::kEnded) return false;
  *error = invalid_text(*identity_, now_s);
  return true;
}

// The writer on the topic of a right, or why there is none.
dds_entity_t ServiceCaller::made_writer(rt::services::Right right, std::string* error) {
  dds_entity_t& made = writers_[static_cast<unsigned>(right)];
  if (made <= 0) made = make_writer(participant_.get(), topic_for(right), control_, 1, error);
  return made;
}

// A writer that a gateway hears.
ServiceCaller::Result ServiceCaller::writer_of(rt::services::Right right, dds_entity_t* writer, std::string* error) {
  const dds_entity_t made = made_writer(right, error);
  if (made <= 0) return made == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY ? Result::kNotAllowed : Result::kNobody;
  *writer = made;
  for (const std::int64_t end = now() + kFindNs; now() < end && !has_expired(error); std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
    dds_publication_matched_status_t matched{};
    if (dds_get_publication_matched_status(made, &matched) >= 0 && matched.current_count > 0) return Result::kDone;
  }
  if (has_expired(error)) return Result::kExpired;
  *error = "nobody takes requests for \"" + control_ + "\" in DDS domain " + std::to_string(access_.domain) + ": is ncdds running, with the same --domain?";
  return Result::kNobody;
}

ServiceCaller::Result ServiceCaller::call(rt::services::Right right, const std::string& service, const std::string& args, ServiceReplyText* reply, std::string* error) {
  dds_entity_t writer = 0;
  if (const Result found = writer_of(right, &writer, error); found != Result::kDone) return found;
  const auto request = std::make_unique<nc_ServiceRequest>();
  request->number = ++number_;
  if (!put(client_, request->client) || !put(service, request->service) || !put(args, request->args)) {
    *reply = {"malformed", R"({"text":"the request is too long"})"};
    return Result::kDone;
  }
  if (const dds_return_t result = dds_write(writer, request.get()); result < 0) {
    *error = std::string("the request cannot be written: ") + dds_strretcode(result);
    return Result::kNobody;
  }
  const std::int64_t end = now() + kPatienceNs;
  while (whole_.count(number_) == 0 && wait(end)) take();
  const auto found = whole_.find(number_);
  if (found == whole_.end()) {
    if (has_expired(error)) return Result::kExpired;
    *error = "the control does not answer";
    return Result::kNobody;
  }
  *reply = std::move(found->second);
  whole_.clear();  // a reply to an earlier request would be one that came too late
  return Result::kDone;
}

ServiceCaller::Result ServiceCaller::next_update(std::string* body, std::string* error) {
  const std::int64_t end = now() + kPatienceNs;
  while (updates_.empty() && wait(end)) take();
  if (updates_.empty()) {
    if (has_expired(error)) return Result::kExpired;
    *error = "no update comes any more";
    return Result::kNobody;
  }
  *body = std::move(updates_.front());
  updates_.pop_front();
  return Result::kDone;
}

// Waits for samples. False when the time is over, or the identity has ended.
bool ServiceCaller::wait(std::int64_t until_ns) {
  std::int64_t rest = until_ns - now();
  if (identity_) rest = std::min(rest, identity_->ends_s * kSecond - rt::share::wall_ns());
  dds_attach_t triggered[1];
  return rest > 0 && dds_waitset_wait(waitset_, triggered, 1, rest) >= 0;
}

void ServiceCaller::take() {
  void* samples[kTaken] = {};
  dds_sample_info_t infos[kTaken];
  const int count = dds_take(replies_, samples, infos, kTaken, kTaken);
  for (int i = 0; i < count; ++i) {
    const auto& sample = *static_cast<const nc_ServiceReply*>(samples[i]);
    if (infos[i].valid_data && client_ == sample.client) add_part(sample, infos[i].publication_handle);
  }
  if (count > 0) (void)dds_return_loan(replies_, samples, count);
}

// A gateway that takes over from another one begins a reply anew that the other one has not written to its end.
void ServiceCaller::add_part(const nc_ServiceReply& sample, dds_instance_handle_t writer) {
  Parts& parts = parts_[sample.number];
  if (sample.part == 1) parts = {writer, 0, ""};
  if (parts.writer != writer || sample.part != parts.count + 1) return;
  ++parts.count;
  parts.text += sample.body;
  if (!sample.last) return;
  if (sample.status == nc_SERVICE_UPDATE) updates_.push_back(std::move(parts.text));
  else whole_[sample.number] = {sample.refusal, std::move(parts.text)};
  parts_.erase(sample.number);
}

}  // namespace nc::dds
