// SPDX-License-Identifier: Apache-2.0
// Only one control may run a machine. Two processes that write the same outputs would undo in every cycle what the other one does. So a
// control locks everything that belongs to its machine before it touches an output, and a second control is told which process has the lock.
//
// Each of these has a lock of its own, because two controls must not share even one of them:
//   - the file of the configuration: by its path, and by device and inode (links, and a file that was replaced meanwhile)
//   - each Modbus unit that outputs are written to: address, port and unit, however the host is written
//   - each GPIO line
//   - each file of retained data
// The kernel removes the locks when the process ends, in whatever way it ends. A lock is the name of a socket in the abstract namespace of Linux:
// it needs no folder, no access rights and no cleaning up, and it works between different users. It does not reach beyond the network namespace
// of a container. Therefore flock() is also called on the file of the configuration, which works wherever that file is the same.
#pragma once

#include <string>
#include <vector>

#include "runtime/config.hpp"

namespace nc::rt {

// One thing that only one control may use at a time.
struct MachineResource {
  std::string key;      // identifies the thing; the same in every process
  std::string meaning;  // for people: "Modbus unit 1 of 10.0.0.5 port 502"
};

// Everything in a configuration that only one control may use at a time. `retained`: include its files of retained data, which a control on
// virtual time does not touch. Names of hosts are resolved, which may take some time.
std::vector<MachineResource> machine_resources(const Config& config, bool retained);

class MachineLock {
 public:
  MachineLock() = default;
  ~MachineLock();
  MachineLock(const MachineLock&) = delete;
  MachineLock& operator=(const MachineLock&) = delete;

  // Takes all locks or none. False with a sentence in *error that says what is in use, and by which process if that is known.
  bool take(const std::vector<MachineResource>& resources, std::string* error);
  // Calls flock() on the file of the configuration. On a file system without locks it succeeds, and only the other locks protect the machine.
  bool take_file(const std::string& path, std::string* error);
  // Takes everything that belongs to the machine of a configuration. A machine on virtual time without a bus has no outputs, so nothing is locked
  // and any number of processes may simulate it.
  bool take_machine(const Config& config, bool virtual_time, std::string* error);
  void release();

 private:
  std::vector<int> held_;
};

}  // namespace nc::rt
