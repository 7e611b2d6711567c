// SPDX-License-Identifier: Apache-2.0
// Requests and their answers, whatever they travel on. See session.hpp.
#include "hal/modbus/session.hpp"

#include <modbus/modbus.h>

#include <array>
#include <cerrno>

#include "hal/modbus/rtu_session.hpp"
#include "hal/modbus/tcp_session.hpp"

namespace nc::hal::modbus {

void Session::FreeContext::operator()(_modbus* context) const {
  modbus_free(context);
}

Session::~Session() = default;

bool Session::set_up(_modbus* context) {
  context_.reset(context);
  if (context == nullptr) return false;
  modbus_set_error_recovery(context, MODBUS_ERROR_RECOVERY_NONE);
  const auto seconds = [](unsigned ms) { return ms / 1000; };
  const auto micros = [](unsigned ms) { return ms % 1000 * 1000; };
  modbus_set_response_timeout(context, seconds(config_.response_timeout_ms), micros(config_.response_timeout_ms));
  modbus_set_byte_timeout(context, seconds(config_.byte_timeout_ms), micros(config_.byte_timeout_ms));
  return true;
}

bool Session::adopt(int fd) {
  const std::lock_guard lock(mutex_);
  if (aborted_) return false;
  fd_ = fd;
  return true;
}

bool Session::ready(const Block& block) {
  error_.clear();
  exception_ = 0;
  if (fd_ < 0) {
    error_ = "not connected";
    return false;
  }
  if (modbus_set_slave(context_.get(), block.unit) != 0) {
    error_ = "unit " + std::to_string(block.unit) + " is not possible";
    close();
    return false;
  }
  return clear_to_send();
}

Result Session::exchange(const Block& block, const Frame& request, std::uint8_t* answer) {
  int error = send_all(request);
  int size = 0;
  if (error == 0 && (size = receive(request, answer)) <= 0) error = size < 0 ? errno : EMBBADDATA;
  const char* why = "";
  const Verdict verdict = error != 0 ? Verdict::kForeign
                                     : check_answer(request, answer, static_cast<std::size_t>(size), &exception_, &why);
  if (verdict == Verdict::kGood) return Result::kOk;
  if (error == EMBBADDATA) why = "the answer is no Modbus";
  else if (error != 0) why = modbus_strerror(error);
  error_ = place_text(block) + ", function " + std::to_string(request.function()) + ": " + why;
  if (verdict == Verdict::kException) return Result::kException;
  doubt(error);
  return error == ETIMEDOUT ? Result::kTimeout : Result::kFailed;
}

Result Session::read(const Block& block, std::uint16_t* cells) {
  if (!ready(block)) return Result::kFailed;
  std::array<std::uint8_t, kMaxFrame> answer{};
  const Result result = exchange(block, read_request(block, ++transaction_), answer.data());
  if (result == Result::kOk) take_cells(block, answer.data(), cells);
  return result;
}

Result Session::write(const Block& block, const std::uint16_t* cells) {
  if (!ready(block)) return Result::kFailed;
  std::array<std::uint8_t, kMaxFrame> answer{};
  return exchange(block, write_request(block, cells, ++transaction_), answer.data());
}

std::unique_ptr<Session> make_session(const LinkConfig& config) {
  if (!config.serial.device.empty()) return std::make_unique<RtuSession>(config);
  return std::make_unique<TcpSession>(config);
}

}  // namespace nc::hal::modbus
