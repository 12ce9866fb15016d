type workers = Automatic | Workers of int
type mode = Local of workers | Server of { host : string; port : int }

let ( / ) = Filename.concat

(* Java's own options. Residuals and the tasks in a program are trees, and TLC goes through them by recursion. *)
let java (i : Installation.t) ~short =
  (i.java :: (if short then [ "-XX:+UseSerialGC"; "-XX:TieredStopAtLevel=1" ] else [ "-XX:+UseParallelGC" ]))
  @ [ "-Xss64m"; "-Dfile.encoding=UTF-8"; "-Duser.language=en"; "-Duser.country=US" ]

let port_option port = Printf.sprintf "-Dtlc2.tool.distributed.TLCServer.port=%d" port

let of_mode (i : Installation.t) = function
  | Local workers ->
    let workers = match workers with Automatic -> "auto" | Workers n -> string_of_int n in
    [ "-cp"; i.jar; "tlc2.TLC"; "-workers"; workers ]
  | Server { host; port } ->
    [ "-Djava.rmi.server.hostname=" ^ host; port_option port; "-cp"; i.jar; "tlc2.tool.distributed.TLCServer" ]

(* [-deadlock] turns the search for deadlocks off: an end has no successor either, so models have an invariant for
   that. The distributed server ignores CHECK_DEADLOCK in the configuration. *)
let command ?(short = false) ?(coverage = false) i mode ~directory ~main ~configuration =
  java i ~short
  @ [ "-Djava.io.tmpdir=" ^ directory ]
  @ of_mode i mode
  @ (if coverage then [ "-coverage"; "1" ] else [])
  @ [ "-tool"; "-deadlock"; "-metadir"; directory / "states"; "-config"; configuration; main ^ ".tla" ]

let worker i ~host ~port =
  java i ~short:false @ [ port_option port; "-cp"; i.jar; "tlc2.tool.distributed.TLCWorker"; host ]
