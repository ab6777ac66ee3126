async function g(r,t,e,n){let s;for(;!n.aborted;){try{let a=await fetch(r,{headers:{...t,...s===void 0?{}:{"Last-Event-ID":s}},signal:n});if(a.status===401||a.status===403)return;if(a.ok&&a.body){e({kind:"connected"}),s===void 0&&e({kind:"reset"});for await(let o of c(a.body))s=o.id??s,e(d(o))}}catch{if(n.aborted)return}if(n.aborted)return;e({kind:"lost"}),await new Promise(i=>setTimeout(i,1e3))}}function d({event:r,data:t}){return r==="reset"?{kind:"reset"}:{kind:r,...JSON.parse(t)}}async function*c(r){for await(let t of u(r)){let e=m(t);e&&(yield e)}}async function*u(r){let t=r.pipeThrough(new TextDecoderStream).getReader(),e="";try{for(;;){let{done:n,value:s}=await f(t.read(),35e3);if(n)return;let i=(e+s).replaceAll(`\r
`,`
`).split(`

`);e=i.pop()??"",yield*i}}finally{t.cancel().catch(()=>{})}}async function f(r,t){let e,n=new Promise((s,i)=>{e=setTimeout(()=>i(new Error("the stream is silent")),t)});try{return await Promise.race([r,n])}finally{clearTimeout(e)}}function m(r){let t={event:"message",data:""},e=[];for(let n of r.split(`
`)){let s=n.slice(n.indexOf(":")+1).replace(/^ /,"");n.startsWith("id:")?t.id=s:n.startsWith("event:")?t.event=s:n.startsWith("data:")&&e.push(s)}return e.length===0?void 0:{...t,data:e.join(`
`)}}export{g as a,u as b};
