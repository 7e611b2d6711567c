// SPDX-License-Identifier: Apache-2.0
// Makes a bank of GPIO lines from the configuration, and lists the lines that no other control may use at the same time. See bus_gpio.hpp.
#include "runtime/bus_gpio.hpp"

#include "hal/gpio/gpio_bus.hpp"
#include "runtime/machine_lock.hpp"

namespace nc::rt {

#ifdef NC_HAVE_LIBGPIOD
std::unique_ptr<hal::PointBus> make_gpio(const Config& config, const PointBusConfig& bus, hal::Hal*, const BusReport& report) {
  return std::make_unique<hal::gpio::GpioBus>(config.gpio[bus.place].bank, hal::gpio::make_gpiod_chip(), report);
}
#endif

// The same line under two spellings (chip by path or by label, line by name or by offset) gives two different locks here. Then the kernel refuses
// the second owner.
void gpio_resources(const Config& config, const PointBusConfig& bus, std::vector<MachineResource>* resources) {
  const hal::gpio::BankConfig& bank = config.gpio[bus.place].bank;
  const auto add = [&](const hal::gpio::LineSetup& line) {
    std::string key("gpio "), words("GPIO line ");
    key.append(bank.chip).append(line.name.empty() ? " offset " : " name ").append(line.text());
    words.append(line.text()).append(" of chip ").append(bank.chip);
    resources->push_back({key, words});
  };
  for (const hal::gpio::PointLine& line : bank.lines) add(line.line);
  for (const hal::gpio::Encoder& encoder : bank.encoders) {
    add(encoder.a);
    add(encoder.b);
  }
  if (bank.has_watchdog) add(bank.watchdog);
}

}  // namespace nc::rt
