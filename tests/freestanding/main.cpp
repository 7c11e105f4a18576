// Runs the scene where no system call is possible: between steps the operating system kills the process for any but
// read, write and exit (strict mode of Linux). With the argument `control` it makes a forbidden call and must be
// killed.
//
// Exit code: 0 done, 1 the scene stopped with a fault or did nothing, 77 the system has no strict mode; killed
// otherwise.
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "scene.hpp"

int main(int argc, char**) {
  if (prctl(PR_SET_SECCOMP, SECCOMP_MODE_STRICT) != 0) return 77;
  const bool is_control = argc > 1;
  if (is_control) syscall(SYS_getpid);
  bool ok = scene_start();
  for (int block = 0; block < 20; ++block) ok = ok && scene_run(100);
  ok = ok && scene_kinetic_energy() > 0 && scene_listings() > 3;
  syscall(SYS_exit, ok ? 0 : 1);  // exit() ends the group of threads, which is forbidden
}
