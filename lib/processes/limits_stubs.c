/* Limits of a process: see limits.mli. */

#define CAML_NAME_SPACE
#include <caml/fail.h>
#include <caml/mlvalues.h>
#include <signal.h>
#include <sys/resource.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

/* A lower limit that the process already has stays: most systems do not let it be raised. */
value dolphin_limit_memory(value megabytes)
{
  struct rlimit limit;
  rlim_t wanted = (rlim_t) Long_val(megabytes) * 1024 * 1024;

  if (getrlimit(RLIMIT_AS, &limit) == -1) caml_failwith("memory cannot be limited");
  if (limit.rlim_max == RLIM_INFINITY || limit.rlim_max > wanted) limit.rlim_max = wanted;
  if (limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur > limit.rlim_max) limit.rlim_cur = limit.rlim_max;
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
