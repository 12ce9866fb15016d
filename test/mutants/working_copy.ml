type t = { root : string; sound : (string, bool) Hashtbl.t }

let read path =
  let channel = open_in_bin path in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

let write path text =
  let channel = open_out_bin path in
  output_string channel text;
  close_out channel

let shell format = Printf.ksprintf (fun command -> Sys.command command = 0) format

let marker root = Filename.concat root ".mutants"

(* A folder of its own, which is removed at the end, or the one that is named. *)
let folder () =
  match Sys.getenv_opt "COPY" with
  | None | Some "" ->
    let root = Filename.temp_file "mutants" "" in
    Sys.remove root;
    Unix.mkdir root 0o700;
    at_exit (fun () -> ignore (shell "rm -rf %s" (Filename.quote root)));
    root
  | Some root ->
    if not (Sys.file_exists root) then Unix.mkdir root 0o700
    else if not (Sys.file_exists (marker root)) then failwith (root ^ " is not a copy that this program made");
    root

let with_copy f =
  Sys.set_signal Sys.sigint (Signal_handle (fun _ -> exit 130));
  Sys.set_signal Sys.sigterm (Signal_handle (fun _ -> exit 143));
  let root = folder () in
  write (marker root) "";
  let quoted = Filename.quote root in
  let emptied = shell "find %s -mindepth 1 -maxdepth 1 ! -name _build ! -name .mutants -exec rm -rf {} +" quoted in
  let copied () = shell "tar --exclude=./_build --exclude='./.[a-z]*' -cf - . | tar -xf - -C %s" quoted in
  if not (emptied && copied ()) then failwith "the tree cannot be copied";
  f { root; sound = Hashtbl.create 64 }

(* Of the warnings only that of a match with a missing case stays: a mistake that leaves a name unused is one. *)
let lenient = "OCAMLPARAM='_,w=-a+8'"

(* A mistake may make a test run or wait without end, or take all memory. The limit is in seconds of CPU, so that
   other load makes no test fail. Random tests take their usual inputs, which are known to notice it. *)
let limited = "unset SEED DOLPHIN_SEED COUNT; ulimit -v 4000000; ulimit -t 100; timeout 1000"

let dune copy target = Printf.sprintf "%s dune build --root %s %s" lenient copy.root target

let is_alias test = test.[0] = '@'
let executable test = Printf.sprintf "test/%s.exe" test
let builds copy test = is_alias test || shell "%s >%s/build.log 2>&1" (dune copy (executable test)) copy.root

let passes copy test =
  if is_alias test then shell "(%s env %s) >%s/run.log 2>&1" limited (dune copy test) copy.root
  else
    let folder = Filename.concat copy.root (Filename.dirname (executable test)) in
    let program = Filename.concat copy.root ("_build/default/" ^ executable test) in
    shell "cd %s && (%s %s >%s/run.log 2>&1)" folder limited program copy.root

let source copy file = read (Filename.concat copy.root file)

type verdict = Noticed of string | Passed | Not_built

(* In the tree without a mistake. *)
let is_sound copy test =
  match Hashtbl.find_opt copy.sound test with
  | Some sound -> sound
  | None ->
    let sound = builds copy test && passes copy test in
    if not sound then Printf.printf "%s fails without any mistake\n%!" test;
    Hashtbl.add copy.sound test sound;
    sound

let judge copy ~file text ~tests =
  let path = Filename.concat copy.root file in
  let original = read path in
  let wrong () = write path text and right () = write path original in
  let rec by = function
    | [] -> Passed
    | test :: others when Hashtbl.find_opt copy.sound test = Some false -> by others
    | test :: others ->
      wrong ();
      if not (builds copy test) then Not_built
      else if passes copy test then by others
      else (right (); if is_sound copy test then Noticed test else by others)
  in
  Fun.protect ~finally:right (fun () -> by tests)
