open Dolphin_syntax.Ast
module Names = Set.Make (String)
module String_map = Map.Make (String)

(* Of a name: its only value, if it gets one in one place only; and whether it gets a value at all that does not depend
   on an earlier one. *)
type values = { only : expression option; is_given : bool }

let note name ?(is_given = true) only acc =
  let add = function
    | None -> Some { only; is_given }
    | Some before -> Some { only = None; is_given = before.is_given || is_given }
  in
  String_map.update name add acc

let rec assignments acc (s : statement) =
  match s.it with
  | Assign { target = { it = Variable name; _ }; operator = None; value } -> note name (Some value) acc
  | Assign { target = { it = Variable name; _ }; operator = Some _; _ } -> note name ~is_given:false None acc
  | Parameter { name; value; _ } -> note name.it (Some value) acc
  | Define (name, value) -> note name.it value acc
  | For (name, _, body) -> List.fold_left assignments (note name.it None acc) body
  | If (_, yes, no) -> List.fold_left assignments acc (yes @ no)
  | While (_, body) | Block body -> List.fold_left assignments acc body
  | Function { parameters; body; _ } -> List.fold_left assignments (List.fold_left hide acc parameters) body
  | Assign _ | Expression _ | Setting _ | Return _ | Break | Continue -> acc

(* Parameters hide variables of the same name. *)
and hide acc (x : string located) = note x.it None acc

(* Code inside of expressions assigns too. *)
let assignments_inside acc (e : expression) =
  match e.it with
  | Closure c | When (c, _) | Wait_for (c, _) | Until (_, c, _) | Watch (_, c) | Ensure (_, c)
  | Repeat { until = Some c; _ } ->
    List.fold_left hide (List.fold_left assignments acc c.body) (Option.value c.parameters ~default:[])
  | Recruit (settings, c) ->
    let acc = List.fold_left assignments acc (settings @ c.body) in
    List.fold_left hide acc (Option.value c.parameters ~default:[])
  | Builder (_, body) -> List.fold_left assignments acc body
  | Pick_else (settings, otherwise) -> List.fold_left assignments acc (settings @ otherwise)
  | Increment { target = { it = Variable name; _ }; _ } -> note name ~is_given:false None acc
  | _ -> acc

let table ast =
  List.fold_left (Fold.statement assignments_inside) (List.fold_left assignments String_map.empty ast) ast

(* Many checks ask about one program, one after the other. *)
let latest = ref ([], String_map.empty)

let values ast =
  let known, found = !latest in
  if known == ast then found
  else begin
    let found = table ast in
    latest := (ast, found);
    found
  end

let filtered is ast =
  String_map.fold (fun x of_name found -> if is of_name then Names.add x found else found) (values ast) Names.empty

let names ast = filtered (fun _ -> true) ast
let given ast = filtered (fun v -> v.is_given) ast
let once wanted ast = filtered (fun v -> Option.fold v.only ~none:false ~some:wanted) ast
