// SPDX-License-Identifier: Apache-2.0
// One control for one machine. Two processes that write the same outputs would undo what the other does with each cycle, so a
// control takes everything that makes its machine before it touches an output, and whoever comes second is told who has it.
//
// What makes a machine, each under a lock of its own, because any one of them in common is one too many:
//   - the file of the configuration: by its path, and by device and inode (links, and a file that was replaced meanwhile)
//   - each Modbus unit that outputs are written to: address, port and unit, however the host is written
//   - each GPIO line
//   - each file of retained data
// The locks die with the process, whatever ends it. A lock is the name of a socket in the abstract namespace of Linux: no folder,
// no rights and no cleaning up are needed, and it counts between users. The namespace ends at the network namespace of a container;
// the configuration is under flock(), too, which counts beyond it where the file is the same.
#pragma once

#include <string>
#include <vector>

#include "runtime/config.hpp"

namespace nc::rt {

// One thing that a machine has for itself.
struct MachineResource {
  std::string key;      // the same for the same thing, in every process
  std::string meaning;  // for people: "Modbus unit 1 of 10.0.0.5 port 502"
};

// What the machine of a configuration has for itself. `retained`: its files of retained data, too, which a control on
// virtual time does not touch. Names of hosts are looked up: this may take the time of the resolver.
std::vector<MachineResource> machine_resources(const Config& config, bool retained);

class MachineLock {
 public:
  MachineLock() = default;
  ~MachineLock();
  MachineLock(const MachineLock&) = delete;
  MachineLock& operator=(const MachineLock&) = delete;

  // All of them, or none. False with a sentence in *error that says what is taken, and by which process where that is known.
  bool take(const std::vector<MachineResource>& resources, std::string* error);
  // flock() on the file of the configuration. A file system that knows no locks leaves it at the other ones.
  bool take_file(const std::string& path, std::string* error);
  // Everything that makes the machine of a configuration. A machine on virtual time without a bus has no outputs: whoever wants may simulate it as
  // often as he likes, and nothing is taken.
  bool take_machine(const Config& config, bool virtual_time, std::string* error);
  void release();

 private:
  std::vector<int> held_;
};

}  // namespace nc::rt
