open Dolphin_semantics
module Limits = Dolphin_checker.Limits

type 'run t = {
  endings : (Timed_system.ending * Timed_system.date) list;
  tasks : (Timed_system.task * (Timed_system.moment * Timed_system.date) list) list;
  missed : (Core.site * Timed_system.date) list;
  first : 'run option;
  stopped : Limits.bound option;
  states : int;
  depth : int;
  bytes : int;
}

let nothing bound =
  { endings = []; tasks = []; missed = []; first = None; stopped = Some bound; states = 0; depth = 0; bytes = 0 }

let with_run f e = { e with first = Option.map f e.first }
