(* The reference interpreter: speaks the protocol of [dolphin step] by the function that proofs/ is about. *)

let () =
  set_binary_mode_in stdin true;
  let transitions = { Dolphin_conformance.Oracle.internal = Reference.internal; accept = Reference.accept } in
  let oracle = Dolphin_conformance.Oracle.start_with transitions ~name:"dolphin, extracted from proofs/" in
  Dolphin_app.Oracle_server.serve_as oracle stdin stdout
