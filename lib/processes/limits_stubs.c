/* Limits of a process: see limits.mli. */

#define CAML_NAME_SPACE
#include <caml/fail.h>
#include <caml/mlvalues.h>
#include <signal.h>
#include <sys/resource.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

value dolphin_limit_memory(value megabytes)
{
  struct rlimit limit;

  limit.rlim_cur = limit.rlim_max = (rlim_t) Long_val(megabytes) * 1024 * 1024;
  if (setrlimit(RLIMIT_AS, &limit) == -1) caml_failwith("memory cannot be limited");
  return Val_unit;
}

value dolphin_end_with_parent(value unit)
{
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  return unit;
}
