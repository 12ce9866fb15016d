type t = { known : (int * int, unit) Hashtbl.t; mutable edges : (int * int) list }

let create () = { known = Hashtbl.create 64; edges = [] }
let edges t = t.edges

let follows t place place' =
  if not (Hashtbl.mem t.known (place, place')) then begin
    Hashtbl.add t.known (place, place') ();
    t.edges <- (place, place') :: t.edges
  end

(* Places without successors are removed repeatedly: any remaining places lie on cycles, or lead to them. *)
let may_cycle t =
  let before = Hashtbl.create 64 and following = Hashtbl.create 64 in
  let edge (place, place') =
    Hashtbl.add before place' place;
    let n = Option.value (Hashtbl.find_opt following place) ~default:0 in
    Hashtbl.replace following place (n + 1);
    if not (Hashtbl.mem following place') then Hashtbl.add following place' 0
  in
  List.iter edge t.edges;
  let ends = Stack.create () and left = ref (Hashtbl.length following) in
  Hashtbl.iter (fun place n -> if n = 0 then Stack.push place ends) following;
  while not (Stack.is_empty ends) do
    decr left;
    let less place =
      let n = Hashtbl.find following place - 1 in
      Hashtbl.replace following place n;
      if n = 0 then Stack.push place ends
    in
    List.iter less (Hashtbl.find_all before (Stack.pop ends))
  done;
  !left > 0
