(* No program or fleet is larger: what is, was named by mistake. *)
let most_bytes = 64 * 1024 * 1024

let read_all channel =
  let contents = Buffer.create 65536 and chunk = Bytes.create 65536 in
  let rec go () =
    let n = input channel chunk 0 (Bytes.length chunk) in
    Buffer.add_subbytes contents chunk 0 n;
    if Buffer.length contents > most_bytes then Error "the file is larger than 64 MB"
    else if n = 0 then Ok (Buffer.contents contents)
    else go ()
  in
  go ()

let read path =
  let read () =
    if Sys.file_exists path && Sys.is_directory path then Error "this is a directory, not a file"
    else
      let channel = open_in_bin path in
      Fun.protect ~finally:(fun () -> close_in_noerr channel) (fun () -> read_all channel)
  in
  if path = "" then Error "the name of the file is empty"
  else
    match read () with
    | result -> Result.map_error (fun why -> path ^ ": " ^ why) result
    | exception Sys_error why ->
      (* "x.dol: No such file or directory"; reading, not opening, leaves out the name. *)
      let named = String.length why > String.length path && String.sub why 0 (String.length path) = path in
      Error (if named then why else path ^ ": " ^ why)
