type t = {
  id : string option;
  kind : string option;
  payload : string list;
  region : Dolphin_geo.Area.t option;
}

let compare a b =
  Order.both (Option.compare String.compare a.id b.id) (fun () ->
      Order.both (Option.compare String.compare a.kind b.kind) (fun () ->
          Order.both (List.compare String.compare a.payload b.payload) (fun () ->
              Option.compare Dolphin_geo.Area.compare a.region b.region)))
