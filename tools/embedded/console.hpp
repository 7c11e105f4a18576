// Text output for programs that run with and without operating system.
//
// With one it is standard output. Without, semihosting: the program stops at a breakpoint that the debugger or emulator
// takes for a request (Arm's "Semihosting for AArch32 and AArch64"), with a number and one word of parameters.
#pragma once

#if __STDC_HOSTED__
#include <cstdio>
#endif

namespace fixdem::console {

#if !__STDC_HOSTED__
enum Request { write_text = 0x04, read_command_line = 0x15, exit_with_code = 0x20 };

inline int ask(Request request, const void* parameter) {
  register int number asm("r0") = request;
  register const void* word asm("r1") = parameter;
  asm volatile("bkpt 0xab" : "+r"(number) : "r"(word) : "memory");
  return number;
}
#endif

inline void put(const char* text) {
#if __STDC_HOSTED__
  std::fputs(text, stdout);
#else
  ask(write_text, text);
#endif
}

inline void put(unsigned long long value, unsigned base = 10, int digits = 1) {
  char text[24];
  int at = 23;
  text[at] = '\0';
  for (; value > 0 || digits > 0; value /= base, --digits) text[--at] = "0123456789abcdef"[value % base];
  put(text + at);
}

inline void put_hash(unsigned long long hash) { put(hash, 16, 16); }

}  // namespace fixdem::console
