/* What the standard library does not tell of terminals: how large one is, and who may use it. */
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>
#include <caml/alloc.h>
#include <caml/memory.h>
#include <caml/mlvalues.h>

/* Rows and columns; 0 and 0 if [fd] is no terminal. */
value dolphin_terminal_size(value fd) {
  CAMLparam1(fd);
  CAMLlocal1(size);
  struct winsize window = {0};
  if (ioctl(Int_val(fd), TIOCGWINSZ, &window) != 0) window.ws_row = window.ws_col = 0;
  size = caml_alloc_tuple(2);
  Store_field(size, 0, Val_int(window.ws_row));
  Store_field(size, 1, Val_int(window.ws_col));
  CAMLreturn(size);
}

value dolphin_terminal_is_ours(value fd) { return Val_bool(tcgetpgrp(Int_val(fd)) == getpgrp()); }
