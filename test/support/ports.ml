let count = 640
let first = 25_000
let blocks = 12

(* Not where temporary files are: runs of tests may have folders of their own for these. *)
let folder = "/tmp/dolphin-test-ports"

(* The file stays open, and so locked. *)
let is_leased_now block =
  let path = Filename.concat folder (string_of_int block) in
  let file = Unix.openfile path [ O_RDWR; O_CREAT; O_CLOEXEC ] 0o666 in
  match Unix.lockf file F_TLOCK 0 with
  | () -> true
  | exception Unix.Unix_error ((EAGAIN | EACCES), _, _) -> Unix.close file; false

let leased = ref []

let lease () =
  (try Unix.mkdir folder 0o777 with Unix.Unix_error (EEXIST, _, _) -> ());
  (* A process may lock what it has locked. *)
  let is_free block = (not (List.mem block !leased)) && is_leased_now block in
  match List.find_opt is_free (List.init blocks (fun k -> first + (k * count))) with
  | Some block -> leased := block :: !leased; block
  | None -> failwith "other tests have all ports: too many run at once"
