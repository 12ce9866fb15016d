/* Descriptors 0 to 2 that are closed are opened on /dev/null before anything else runs: a socket or the descriptor of
   the event loop would take their numbers, and then be read as an answer or written over by the log. Modules that the
   command links open descriptors when they are initialised, so OCaml code would come too late. */

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

__attribute__((constructor)) static void open_standard_descriptors(void)
{
  int fd;

  for (fd = 0; fd <= 2; fd++)
    /* The lowest number that is free is taken. */
    if (fcntl(fd, F_GETFD) == -1 && errno == EBADF && open("/dev/null", O_RDWR) != fd) _exit(3);
}
