type workers = Automatic | Workers of int
type mode = Local of workers | Server of { host : string; port : int }

let main_module = "MC"
let ( / ) = Filename.concat

(* Java's own options. Residuals and the tasks in a program are trees, and TLC goes through them by recursion. *)
let java (i : Installation.t) =
  [ i.java; "-XX:+UseParallelGC"; "-Xss64m"; "-Dfile.encoding=UTF-8"; "-Duser.language=en"; "-Duser.country=US" ]

let port_option port = Printf.sprintf "-Dtlc2.tool.distributed.TLCServer.port=%d" port

let main (i : Installation.t) = function
  | Local workers ->
    let workers = match workers with Automatic -> "auto" | Workers n -> string_of_int n in
    [ "-cp"; i.jar; "tlc2.TLC"; "-workers"; workers ]
  | Server { host; port } ->
    [ "-Djava.rmi.server.hostname=" ^ host; port_option port; "-cp"; i.jar; "tlc2.tool.distributed.TLCServer" ]

let command i mode ~directory ~configuration ~coverage =
  let coverage = if coverage then [ "-coverage"; "60" ] else [] in
  java i
  @ [ "-Djava.io.tmpdir=" ^ directory ]
  @ main i mode
  @ [ "-tool"; "-metadir"; directory / "states"; "-config"; directory / configuration ]
  @ coverage
  @ [ directory / (main_module ^ ".tla") ]

let worker i ~host ~port =
  java i @ [ port_option port; "-cp"; i.jar; "tlc2.tool.distributed.TLCWorker"; host ]
