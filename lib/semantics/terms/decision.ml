open Dolphin_results

type 'a t = Decided of 'a | Open of (World.assumption * 'a t Lazy.t) list | Unclear of Fault.t

let ask world question f =
  Open (List.map (fun answer -> (answer, lazy (f (World.suppose [ answer ] world)))) question)

let rec look world f =
  match f world with Ok x -> Decided x | Error question -> ask world question (fun world -> look world f)

let rec bind d f =
  match d with
  | Decided x -> f x
  | Open ways -> Open (List.map (fun (assumption, d) -> (assumption, lazy (bind (Lazy.force d) f))) ways)
  | Unclear fault -> Unclear fault

let map f d = bind d (fun x -> Decided (f x))

let rec cases = function
  | Decided x -> Ok [ ([], x) ]
  | Unclear fault -> Error fault
  | Open ways ->
    let way (assumption, d) =
      Result.map (List.map (fun (assumed, x) -> (assumption :: assumed, x))) (cases (Lazy.force d))
    in
    Results.concat_map way ways

let outcomes ~equal d =
  let of_all all =
    let add kept (assumed, result) =
      match result with
      | Some x when not (List.exists (fun (_, y) -> equal x y) kept) -> (assumed, x) :: kept
      | Some _ | None -> kept
    in
    match List.rev (List.fold_left add [] all) with
    | [ (_, x) ] when List.for_all (fun (_, result) -> Option.is_some result) all -> [ ([], x) ]
    | kept -> kept
  in
  match d with
  | Decided (Some x) -> Ok [ ([], x) ]
  | Decided None -> Ok []
  | Open _ | Unclear _ -> Result.map of_all (cases d)
