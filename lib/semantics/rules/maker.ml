open Core

let deepest = 100
let most_keys = 100_000

let fault (code : closure) format = Printf.ksprintf (fun m -> Error (Fault.make code.lambda.lambda_site m)) format
let many n = Printf.sprintf "%d value%s" n (if n = 1 then "" else "s")

let only_computes (code : closure) =
  fault code "{ %s } makes a task, so it may only compute: it must not post, consume, assign or print"
    code.lambda.label

let task_of (code : closure) given ~depth (s : Shared.t) (after : Shared.t) x deeds =
  let n = List.length given and { parameters; implicit; label; _ } = code.lambda in
  if parameters > n && not implicit then
    fault code "{ %s } takes %s, and its guard took %s" label (many parameters) (if n = 0 then "none" else many n)
  else if depth >= deepest then
    fault code "closures in tasks that closures give nest more than %d deep: write an endless loop as repeat" deepest
  else if deeds <> [] || Store.compare after.store s.store <> 0 then only_computes code
  else
    match x with
    | Task t -> Ok t
    | Closure c -> Ok (Made c)
    | x -> fault code "{ %s }: %s" label (Operators.instead_of "a task" x)

(* The first [n] of [numbers], and the others. *)
let rec split n numbers =
  if n = 0 then ([], numbers)
  else
    match numbers () with
    | Seq.Nil -> invalid_arg "Maker.split: too few numbers"
    | Seq.Cons (first, rest) ->
      let others, rest = split (n - 1) rest in
      (first :: others, rest)

let opened ?held program world s ~numbers ~depth t =
  let inside depth t = List.map (fun code -> (depth, code)) (Allocation.fresh t) in
  let rec from world numbers count found = function
    | [] -> Decision.Decided (world, Ok { Allocation.tasks = List.rev found; numbers })
    | (_, code) :: _ when count >= most_keys ->
      Decided (world, fault code "the task has more than %d times fresh" most_keys)
    | (depth, (code : closure)) :: rest ->
      let ns, numbers = split code.lambda.parameters numbers in
      let given = List.map (fun n -> String (Residual.key n)) ns in
      let go_on world = function
        | Error fault -> Decision.Decided (world, Error fault)
        | Ok t -> from world numbers (count + 1) ((ns, t) :: found) (inside (depth + 1) t @ rest)
      in
      let ran { Run_code.world; outcome; _ } =
        match outcome with
        | Faulty (fault, _) -> go_on world (Error (Fault.make fault.site fault.message))
        | Halts _ -> go_on world (only_computes code)
        | Gives (x, after, deeds) -> (
            match Reading.settled code.lambda.lambda_site x with
            | Error fault -> Unclear fault
            | Ok x -> go_on world (task_of code given ~depth s after x deeds))
      in
      Decision.bind (Run_code.atomic ?held ~given program world s code) ran
  in
  from world numbers 0 [] (inside depth t)
