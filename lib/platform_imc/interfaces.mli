(** The addresses of this machine. *)

val local : unit -> Unix.inet_addr list
(** [local ()] is the IPv4 addresses of this machine, those of networks first, [127.0.0.1] last; the others of the
    loopback interface are left out. Read from [/proc/net/fib_trie]; without it, only the address that multicasts
    would leave from. *)

val of_fib_trie : string list -> Unix.inet_addr list
(** [of_fib_trie lines] is the result of {!local} for that file. *)
