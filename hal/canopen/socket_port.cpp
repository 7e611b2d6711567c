// SPDX-License-Identifier: Apache-2.0
// SocketCAN. See socket_port.hpp.
#include "hal/canopen/socket_port.hpp"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hal/canopen/slcan_port.hpp"
#include "hal/serial_key.hpp"

namespace nc::hal::canopen {
namespace {

BusEvent event_of(const can_frame& frame) {
  if ((frame.can_id & CAN_ERR_BUSOFF) != 0) return BusEvent::kBusOff;
  if ((frame.can_id & CAN_ERR_RESTARTED) != 0) return BusEvent::kRestarted;
  if ((frame.can_id & CAN_ERR_CRTL) != 0) {
    if ((frame.data[1] & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0) return BusEvent::kErrorPassive;
    if ((frame.data[1] & CAN_ERR_CRTL_RX_OVERFLOW) != 0) return BusEvent::kOverflow;
  }
  return BusEvent::kNone;
}

}  // namespace

bool SocketPort::open(std::string* error) {
  close();
  const auto failed = [&](const std::string& what) {
    *error = what + ": " + std::strerror(errno);
    close();
    return false;
  };
  if (interface_.empty() || interface_.size() >= IFNAMSIZ) {
    *error = "no interface can have this name";
    return false;
  }
  fd_ = socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
  if (fd_ < 0) return failed("this kernel has no CAN");
  ifreq request{};
  std::memcpy(request.ifr_name, interface_.c_str(), interface_.size());
  if (ioctl(fd_, SIOCGIFINDEX, &request) != 0) return failed("there is no such interface");
  const int index = request.ifr_ifindex;
  if (ioctl(fd_, SIOCGIFFLAGS, &request) != 0 || (request.ifr_flags & IFF_UP) == 0) {
    errno = ENETDOWN;
    return failed("the interface is not up (ip link set " + interface_ + " up type can bitrate ...)");
  }
  const can_err_mask_t errors = CAN_ERR_BUSOFF | CAN_ERR_RESTARTED | CAN_ERR_CRTL;
  setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors);
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = index;
  if (bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return failed("bind");
  return true;
}

void SocketPort::close() noexcept {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

bool SocketPort::send(const CanFrame& frame) noexcept {
  can_frame raw{};
  raw.can_id = frame.id;
  raw.can_dlc = frame.length;
  std::copy(frame.data, frame.data + kMaxData, raw.data);
  return write(fd_, &raw, sizeof raw) == static_cast<ssize_t>(sizeof raw);
}

// Frames with an identifier of 29 bits and remote frames are skipped, because CANopen does not use them.
bool SocketPort::receive(CanFrame* frame) noexcept {
  for (;;) {
    can_frame raw{};
    if (read(fd_, &raw, sizeof raw) != static_cast<ssize_t>(sizeof raw)) return false;
    *frame = {};
    if ((raw.can_id & CAN_ERR_FLAG) != 0) {
      frame->event = event_of(raw);
      if (frame->event != BusEvent::kNone) return true;
      continue;
    }
    if ((raw.can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG)) != 0) continue;
    frame->id = static_cast<std::uint16_t>(raw.can_id & CAN_SFF_MASK);
    frame->length = std::min<std::uint8_t>(raw.can_dlc, kMaxData);
    std::copy(raw.data, raw.data + kMaxData, frame->data);
    return true;
  }
}

namespace {

constexpr const char* kSerial = "slcan:";

}  // namespace

std::string device_of(const std::string& interface) {
  if (interface.rfind(kSerial, 0) != 0) {
    const unsigned index = ::if_nametoindex(interface.c_str());
    return "canopen " + (index != 0 ? "interface " + std::to_string(index) : interface);
  }
  return serial_key(interface.substr(std::strlen(kSerial)));
}

std::unique_ptr<CanPort> make_port(const std::string& interface, unsigned bit_s) {
  if (interface.rfind(kSerial, 0) == 0) return std::make_unique<SlcanPort>(interface.substr(std::strlen(kSerial)), bit_s);
  return std::make_unique<SocketPort>(interface);
}

}  // namespace nc::hal::canopen
