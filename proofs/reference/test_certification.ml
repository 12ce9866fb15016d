(* Certificates of random programs are accepted, in worlds that leave sensors open too; what is changed in one is
   noticed. *)

open Dolphin_environment
open Dolphin_explore
open Test_support
module Certificate = Dolphin_app.State_certificate
module Limits = Dolphin_checker.Limits
module Gen = QCheck2.Gen
module Kind = Dolphin_explore.Property

let limit = 1_500
let limits = { Limits.none with max_states = Some limit }

(* The properties that hold in all states, and those that do not. *)
let verdicts options program world =
  let found = Search.run { Search.default with environment = options; limits } program world in
  let is_violated property = match List.assoc property found.verdicts with Search.Violated _ -> true | _ -> false in
  (Certificate.holding found, List.filter is_violated Certificate.certifiable)

let skipped = ref 0
let accepted = ref 0
let endless = ref 0
let refuted = ref 0

let fail edges format =
  let edge (e : Certificate.edge) = Printf.sprintf "%s > %d" e.label e.target in
  let state i edges = Printf.sprintf "%d: %s" i (String.concat "; " (List.map edge edges)) in
  let all = String.concat "\n" (Array.to_list (Array.mapi state edges)) in
  Printf.ksprintf (fun why -> QCheck2.Test.fail_reportf "%s\n%s" why all) format

(* One mistake of each kind, at a state with a transition. *)
let mistakes (edges : Certificate.edge list array) place =
  let n = Array.length edges in
  let changed i list = Array.mapi (fun j edges -> if i = j then list else edges) edges in
  let with_some = List.filter (fun i -> edges.(i) <> []) (List.init n Fun.id) in
  match with_some with
  | [] -> []
  | _ -> (
      let i = List.nth with_some (place mod List.length with_some) in
      match edges.(i) with
      | [] -> []
      | e :: rest ->
        let others = List.filter (fun e' -> e' <> e) rest in
        [ ("without it", changed i others);
          ("with another label", changed i ({ e with label = e.label ^ "?" } :: others));
          ("one more", changed i ({ e with label = "end of time" } :: e :: rest));
          ("nowhere", changed i ({ e with target = n } :: others)) ]
        @ if n > 1 then [ ("elsewhere", changed i ({ e with target = (e.target + 1) mod n } :: others)) ] else [] )

let certified options (program, place) world =
  match Certificate.edges limits options program world with
  | Error _ -> incr skipped; true
  | Ok edges ->
    let holds, violated = verdicts options program world in
    let check ~holds edges = Certification.check options program world ~holds edges in
    ( match check ~holds edges with
      | Certified most -> incr (if most = None then endless else accepted)
      | Refuted { state; why } -> fail edges "refuted at state %d: %s" state why );
    let notice what ~holds edges =
      match check ~holds edges with
      | Refuted _ -> incr refuted
      | Certified _ -> fail edges "accepted %s" what
      | exception Invalid_argument _ -> fail edges "an exception %s" what
    in
    List.iter (fun property -> notice (Kind.name property) ~holds:[ property ] edges) violated;
    List.iter (fun (what, edges) -> notice what ~holds edges) (mistakes edges place);
    true

let counts () =
  let many what n least = Alcotest.(check bool) (Printf.sprintf "%d %s" n what) true (n > least) in
  many "accepted" !accepted 100;
  many "without an end" !endless 3;
  many "refuted" !refuted 500

let count = Option.value ~default:80 (Option.bind (Sys.getenv_opt "PROGRAMS") int_of_string_opt)

let () =
  let failing = Environment.failing ~failures:1 Environment.default in
  let case name gen options world =
    let property (ast, place) = certified options (Generate.compile ast, place) world in
    let print (ast, _) = Generate.print ast in
    Property.case ~count name ~print (Gen.pair gen Gen.nat) property
  in
  Alcotest.run "certificates"
    [ ( "certificates",
        [ case "are accepted" Generate.program Environment.default Generate.world;
          case "with failures" Generate.program failing Generate.world;
          case "with sensors" Generate.sensing_program failing Generate.open_world;
          case "of copies" Generate.replicated failing Generate.world;
          Alcotest.test_case "there were many" `Quick counts ] ) ]
