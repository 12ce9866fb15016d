type entry = { state : int array; depth : int; hash : int }

type t = {
  mutable waiting : entry list;
  mutable length : int;
  mutable path : entry list;  (* the last one first *)
  on_path : (int, entry) Hashtbl.t;  (* by hash *)
}

let create () = { waiting = []; length = 0; path = []; on_path = Hashtbl.create 1_024 }
let waiting t = t.length

let push t entry =
  t.waiting <- entry :: t.waiting;
  t.length <- t.length + 1

let pop t =
  match t.waiting with
  | [] -> None
  | entry :: waiting ->
    t.waiting <- waiting;
    t.length <- t.length - 1;
    Some entry

let drop_to t length =
  while t.length > length do
    ignore (pop t)
  done

let rec leave t depth =
  match t.path with
  | entry :: path when entry.depth >= depth ->
    Hashtbl.remove t.on_path entry.hash;
    t.path <- path;
    leave t depth
  | _ -> ()

let enter t entry =
  leave t entry.depth;
  t.path <- entry :: t.path;
  Hashtbl.add t.on_path entry.hash entry

let path t = List.rev_map (fun entry -> entry.state) t.path

let depth_on_path t ~hash state =
  match Hashtbl.find_opt t.on_path hash with
  | Some entry when entry.state = state -> Some entry.depth
  | Some _ | None -> None

let rewrite t f =
  let renewed entry = { entry with state = f entry.state } in
  let all entries = List.rev (List.rev_map renewed entries) in
  t.waiting <- all t.waiting;
  t.path <- all t.path;
  Hashtbl.reset t.on_path;
  List.iter (fun entry -> Hashtbl.add t.on_path entry.hash entry) (List.rev t.path)
