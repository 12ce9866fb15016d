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

let rec leaves d : (World.assumption list * ('a, Fault.t) result) Seq.t =
  fun () ->
  match d with
  | Decided x -> Seq.return ([], Ok x) ()
  | Unclear fault -> Seq.return ([], Error fault) ()
  | Open ways ->
    let way (assumption, d) () =
      Seq.map (fun (assumed, x) -> (assumption :: assumed, x)) (leaves (Lazy.force d)) ()
    in
    Seq.flat_map way (List.to_seq ways) ()

let cases d =
  Results.map (fun (assumed, x) -> Result.map (fun x -> (assumed, x)) x) (List.of_seq (leaves d))

let outcomes ~equal d =
  let rec add assumed x = function
    | (found, y) :: kept when equal x y -> (assumed :: found, y) :: kept
    | other :: kept -> other :: add assumed x kept
    | [] -> [ ([ assumed ], x) ]
  in
  let of_all all =
    let add kept (assumed, result) = Option.fold result ~none:kept ~some:(fun x -> add assumed x kept) in
    match List.fold_left add [] all with
    | [ (_, x) ] when List.for_all (fun (_, result) -> Option.is_some result) all -> [ ([ [] ], x) ]
    | kept -> List.map (fun (found, x) -> (List.rev found, x)) kept
  in
  match d with
  | Decided (Some x) -> Ok [ ([ [] ], x) ]
  | Decided None -> Ok []
  | Open _ | Unclear _ -> Result.map of_all (cases d)
