open Bigarray

type ('a, 'b) t = ('a, 'b, c_layout) Array1.t
type words = (int, int_elt) t

external map : ('a, 'b) kind -> int -> ('a, 'b) t = "dolphin_shared_map"
external forget : ('a, 'b) t -> from:int -> length:int -> unit = "dolphin_shared_forget"
external unmap : ('a, 'b) t -> unit = "dolphin_shared_unmap"

external read : words -> (int[@untagged]) -> (int[@untagged]) = "dolphin_shared_read_bytecode" "dolphin_shared_read"
[@@noalloc]

external write : words -> (int[@untagged]) -> (int[@untagged]) -> unit
  = "dolphin_shared_write_bytecode" "dolphin_shared_write"
[@@noalloc]

external add : words -> (int[@untagged]) -> (int[@untagged]) -> (int[@untagged])
  = "dolphin_shared_add_bytecode" "dolphin_shared_add"
[@@noalloc]

external swap : words -> (int[@untagged]) -> (int[@untagged]) -> (int[@untagged]) -> (int[@untagged])
  = "dolphin_shared_swap_bytecode" "dolphin_shared_swap"
[@@noalloc]

external machine_memory : unit -> int = "dolphin_machine_memory"
external machine_cores : unit -> int = "dolphin_machine_cores"

let swap words i before after = swap words i before after <> 0
