exception Cannot of string

let ignoring f = try f () with Unix.Unix_error _ | Invalid_argument _ -> ()

let bound host port =
  let fd = Unix.socket ~cloexec:true PF_INET SOCK_DGRAM 0 in
  match Unix.bind fd (ADDR_INET (host, port)) with
  | () ->
    Unix.set_nonblock fd;
    ignoring (fun () -> Unix.setsockopt fd SO_BROADCAST true);
    Ok fd
  | exception Unix.Unix_error (error, _, _) -> Unix.close fd; Error (Unix.error_message error)

(* The buffer that the system grants of this holds a tenth of a second of a loud fleet. *)
let receive_buffer = 4 * 1024 * 1024

let first_free host ports =
  let rec find = function
    | [] ->
      let named = String.concat ", " (List.map string_of_int ports) in
      raise (Cannot (Printf.sprintf "all ports for announcements are taken: %s" named))
    | port :: rest -> (match bound host port with Ok fd -> fd | Error _ -> find rest)
  in
  find ports

let port_of fd = match Unix.getsockname fd with ADDR_INET (_, port) -> port | ADDR_UNIX _ -> 0

let listen ~host ~announce_ports ~data_port =
  let announcements = first_free host announce_ports in
  match bound host data_port with
  | Error why ->
    Unix.close announcements;
    raise (Cannot (Printf.sprintf "port %d cannot be had: %s" data_port why))
  | Ok data ->
    ignoring (fun () -> Unix.setsockopt_int data SO_RCVBUF receive_buffer);
    (announcements, data)

let speaker host =
  match bound host 0 with
  | Ok fd ->
    ignoring (fun () -> Lwt_unix.mcast_set_ttl (Lwt_unix.of_unix_file_descr ~blocking:false fd) 15);
    Some fd
  | Error _ -> None

let check_own host =
  match bound host 0 with
  | Ok fd -> Unix.close fd
  | Error _ ->
    raise (Cannot (Printf.sprintf "no interface of this machine has the address %s" (Unix.string_of_inet_addr host)))

let join fd group ~interfaces =
  let join_by ifname = ignoring (fun () -> Lwt_unix.mcast_add_membership fd ~ifname group) in
  List.iter join_by interfaces

let close_quietly fd = ignoring (fun () -> Unix.close fd)
