// SPDX-License-Identifier: Apache-2.0
// Whether somebody has a file open for writing. See open_for_writing.hpp.
//
// Linux grants a lease for reading only when no process has the file open for writing. So this code asks for such a lease and gives it back
// at once. When another process opens the file between these two calls, it waits until the lease is back, and the kernel sends SIGIO to the holder
// of the lease. SIGIO would end this process, so it is directed to this thread, which blocks it during the calls and then removes it.
#include "runtime/programs/open_for_writing.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>

namespace nc::rt {

OpenForWriting open_for_writing(int descriptor) {
  if ((fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY) return OpenForWriting::kNo;  // this process itself has the file open for writing
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
