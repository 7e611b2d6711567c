// SPDX-License-Identifier: Apache-2.0
// Makes a Modbus link from the configuration, and lists the units that no other control may write to at the same time. See bus_modbus.hpp.
#include "runtime/bus_modbus.hpp"

#include <arpa/inet.h>
#include <netdb.h>

#include <set>

#include "hal/modbus/link.hpp"
#include "hal/serial_key.hpp"
#include "runtime/machine_lock.hpp"

namespace nc::rt {
namespace {

// The numerical address in its canonical spelling. An IPv4 address that is mapped into IPv6 (::ffff:10.0.0.5) is written as IPv4.
std::string address_text(const sockaddr* address) {
  char text[INET6_ADDRSTRLEN] = "";
  if (address->sa_family == AF_INET) {
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(address)->sin_addr, text, sizeof text);
  } else if (address->sa_family == AF_INET6) {
    const auto* six = reinterpret_cast<const sockaddr_in6*>(address);
    if (IN6_IS_ADDR_V4MAPPED(&six->sin6_addr)) {
      inet_ntop(AF_INET, six->sin6_addr.s6_addr + 12, text, sizeof text);
    } else {
      inet_ntop(AF_INET6, &six->sin6_addr, text, sizeof text);
      return std::string(text) + (six->sin6_scope_id != 0 ? "%" + std::to_string(six->sin6_scope_id) : "");
    }
  }
  return text;
}

// All addresses of a host. When the name cannot be resolved now, the name itself, so that at least two configurations with the same name share a lock.
std::set<std::string> addresses_of(const std::string& host) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), nullptr, &hints, &found) != 0) return {host};
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> list(found, freeaddrinfo);
  std::set<std::string> addresses;
  for (const addrinfo* entry = found; entry != nullptr; entry = entry->ai_next)
    addresses.insert(address_text(entry->ai_addr));
  return addresses;
}

}  // namespace

std::unique_ptr<hal::PointBus> make_modbus(const Config& config, const PointBusConfig& bus, hal::Hal*, const BusReport& report) {
  return std::make_unique<hal::modbus::ModbusLink>(config.modbus[bus.place].link, report);
}

void modbus_resources(const Config& config, const PointBusConfig& bus, std::vector<MachineResource>* resources) {
  const hal::modbus::LinkConfig& link = config.modbus[bus.place].link;
  if (const std::string& device = link.serial.device; !device.empty()) {  // a line has one master, also where it only reads
    resources->push_back({hal::serial_key(device), "serial line " + device});
    return;
  }
  std::set<unsigned> units;
  for (const hal::modbus::PointMap& map : link.points)
    if (map.output) units.insert(map.unit);
  if (units.empty()) return;  // a control that only reads disturbs no other one
  const std::string port = std::to_string(link.port);
  for (const std::string& address : addresses_of(link.host))
    for (const unsigned unit : units) {
      std::string key("modbus "), words("Modbus unit ");
      key.append(address).append(" ").append(port).append(" ").append(std::to_string(unit));
      words.append(std::to_string(unit)).append(" of ").append(link.host).append(" port ").append(port);
      resources->push_back({key, words});
    }
}

}  // namespace nc::rt
