open Dolphin_semantics

type 'news t = {
  mutable standing : (Residual.timer * string) list;
  mutable were_put : bool;
  mutable shown : (Residual.timer * 'news Lwt.t) option;
}

let create () = { standing = []; were_put = false; shown = None }
let standing t = t.standing
let were_put t = t.were_put
let shown t = Option.map snd t.shown

let put t question prompt =
  t.were_put <- true;
  t.standing <- t.standing @ [ (question, prompt) ]

let withdraw t question =
  t.standing <- List.filter (fun (q, _) -> q <> question) t.standing;
  match t.shown with
  | Some (shown, promise) when shown = question -> t.shown <- None; Lwt.cancel promise
  | Some _ | None -> ()

let show t ~ask =
  match t.standing with
  | (question, prompt) :: _ when t.shown = None -> t.shown <- Some (question, ask question prompt)
  | _ -> ()

let forget t promise =
  match t.shown with
  | Some (_, shown) when shown == promise -> t.shown <- None
  | Some _ | None -> ()

let leave t question = t.shown <- Some (question, fst (Lwt.task ()))

let answered_by t (item : Inputs.item) =
  let is_it (_, prompt) = String.equal prompt item.key in
  match List.find_opt is_it t.standing, Answer.confirmation_of_value item.value with
  | Some (question, _), Some yes -> Some (question, yes)
  | _, _ -> None
