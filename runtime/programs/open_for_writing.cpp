// SPDX-License-Identifier: Apache-2.0
// Whether somebody has a file open for writing. See open_for_writing.hpp.
//
// Linux grants a lease for reading only where nobody has the file open for writing, so trying for one is the question. It is given back at
// once. Somebody who opens the file in the moment between waits for that, and the kernel tells the holder by SIGIO, which would end the
// process: it is sent to this thread alone, which has it blocked meanwhile and takes it off.
#include "runtime/programs/open_for_writing.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>

namespace nc::rt {

OpenForWriting open_for_writing(int descriptor) {
  if ((fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY) return OpenForWriting::kNo;  // it would find itself
  sigset_t io, before;
  sigemptyset(&io);
  sigaddset(&io, SIGIO);
  if (pthread_sigmask(SIG_BLOCK, &io, &before) != 0) return OpenForWriting::kNotTold;
  OpenForWriting open = OpenForWriting::kNotTold;
  const f_owner_ex owner = {F_OWNER_TID, gettid()};
  if (fcntl(descriptor, F_SETOWN_EX, &owner) == 0) {
    if (fcntl(descriptor, F_SETLEASE, F_RDLCK) == 0) {
      fcntl(descriptor, F_SETLEASE, F_UNLCK);
      open = OpenForWriting::kNo;
    } else if (errno == EAGAIN) {
      open = OpenForWriting::kYes;
    }
  }
  if (sigismember(&before, SIGIO) == 0) {
    const struct timespec none = {};
    while (sigtimedwait(&io, nullptr, &none) == SIGIO) {
    }
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return open;
}

}  // namespace nc::rt
