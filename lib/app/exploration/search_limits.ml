let make ?max_states ?max_depth ?max_memory ?timeout ~interrupted ~progress () : Dolphin_checker.Limits.t =
  { max_states; max_depth; max_memory; memory_taken = Memory.taken; memory_left = Memory.left; timeout;
    clock = Unix.gettimeofday; interrupted; progress }
