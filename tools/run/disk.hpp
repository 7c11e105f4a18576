// The one layer through which everything is written: write, fsync and rename of the operating system, counted, so that
// tests can make the n-th of them fail.
//
// FIXDEM_DISK_FAULT=KIND@N in the environment, N from 1:
//   short@N   a write stores only half of its bytes, as a system may; the rest must follow
//   full@N    from the N-th on the disk is full: writes store half of their bytes, then none; fsync fails, too
//   error@N   the N-th fails with EIO, once
//   crash@N   the process kills itself: in a write after half of the bytes, otherwise just before the N-th
//   crashed@N the same, just after the N-th
// Without the variable it costs an increment per operation.
#pragma once

#include <sys/types.h>

#include <cstddef>

namespace fixdem::program::disk {

// As the system's, with errno.
ssize_t write(int descriptor, const void* bytes, std::size_t size);
int fsync(int descriptor);
int rename(const char* from, const char* to);

}  // namespace fixdem::program::disk
