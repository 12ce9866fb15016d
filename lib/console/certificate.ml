open Dolphin_app

type t = { context : Ssl.context; fingerprint : string }

let ( let* ) = Result.bind
let initialised = lazy (Ssl.init ())

let hexadecimal text =
  String.concat "" (List.map (fun c -> Printf.sprintf "%02x" (Char.code c)) (List.of_seq (String.to_seq text)))

let load ~certificate ~key =
  Lazy.force initialised;
  let* () = Result.map ignore (Text_file.read certificate) in
  let* () = Result.map ignore (Text_file.read key) in
  match
    let context = Ssl.create_context Ssl.SSLv23 Ssl.Server_context in
    Ssl.disable_protocols context [ Ssl.SSLv3; Ssl.TLSv1; Ssl.TLSv1_1 ];
    Ssl.use_certificate context certificate key;
    { context; fingerprint = hexadecimal (Ssl.digest `SHA256 (Ssl.read_certificate certificate)) }
  with
  | found -> Ok found
  | exception (Ssl.Certificate_error _ | Ssl.Private_key_error _ | Ssl.Unmatching_keys | Ssl.Context_error) ->
    let why = Printf.sprintf "%s and %s are not a certificate and its private key, in PEM" certificate key in
    Error (Error.Bad_input why)

(* {1 One that signs itself} *)

let is_address name = match Unix.inet_addr_of_string name with _ -> true | exception Failure _ -> false

let run command =
  let null = Unix.openfile "/dev/null" [ O_RDWR; O_CLOEXEC ] 0 in
  let finally () = Unix.close null in
  Fun.protect ~finally (fun () ->
      match Unix.create_process command.(0) command null null null with
      | pid -> snd (Unix.waitpid [] pid) = WEXITED 0
      | exception Unix.Unix_error _ -> false)

(* Days that a certificate lasts: browsers refuse those that last longer. *)
let days = 397

let renewed_before = 30 * 24 * 3600

let is_valid path =
  Sys.file_exists path
  && run [| "openssl"; "x509"; "-checkend"; string_of_int renewed_before; "-noout"; "-in"; path |]

(* The private key and the certificate are in one file, which appears at once, and which only its owner may read. *)
let make ~name path =
  let fresh = Printf.sprintf "%s.%d" path (Unix.getpid ()) in
  let alternative = (if is_address name then "IP:" else "DNS:") ^ name in
  let mask = Unix.umask 0o077 in
  let made =
    Fun.protect ~finally:(fun () -> ignore (Unix.umask mask : int)) (fun () ->
        run
          [| "openssl"; "req"; "-x509"; "-newkey"; "ec"; "-pkeyopt"; "ec_paramgen_curve:prime256v1"; "-nodes"; "-days";
             string_of_int days; "-subj"; "/CN=dolphin console"; "-addext"; "subjectAltName=" ^ alternative; "-keyout";
             fresh; "-out"; fresh ^ ".crt" |])
  in
  let both () =
    let* certificate = Text_file.read (fresh ^ ".crt") in
    match
      let channel = open_out_gen [ Open_append; Open_binary ] 0o600 fresh in
      Fun.protect ~finally:(fun () -> close_out_noerr channel) (fun () ->
          output_string channel certificate;
          close_out channel);
      Unix.rename fresh path
    with
    | () -> Ok ()
    | exception Sys_error why -> Error (Error.Unavailable (Text_file.named path why))
    | exception Unix.Unix_error (error, _, _) ->
      Error (Error.Unavailable (Printf.sprintf "%s: %s" path (Unix.error_message error)))
  in
  let why = "no certificate can be made: the command openssl is missing, or fails" in
  let result = if made then both () else Error (Error.Unavailable why) in
  List.iter (fun path -> try Sys.remove path with Sys_error _ -> ()) [ fresh; fresh ^ ".crt" ];
  result

let own ~name =
  let* folder = Run_folder.beside "certificates" in
  let path = Filename.concat folder (name ^ ".pem") in
  let* () = if is_valid path then Ok () else make ~name path in
  load ~certificate:path ~key:path

let with_fingerprint c link = link ^ "#sha256=" ^ c.fingerprint
